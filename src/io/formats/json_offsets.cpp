// Offset curves as JSON.

#include <fmt/format.h>

#include "io/formats/json.h"
#include "io/formats/json_text.h"
#include "io/ring_text.h"

namespace medial::io {

namespace {

void put_ring(OutputStream& out, const Ring& ring) {
  put_list(out, numbers_below(ring.points.size()), [&](std::size_t p) {
    const double bulge = bulge_after(ring, p);
    if (bulge != 0)
      put_row(out, ring.points[p].x, ring.points[p].y, bulge);
    else
      put_row(out, ring.points[p].x, ring.points[p].y);
  });
}

void put_region(OutputStream& out, const OffsetRegion& region, const BufferSource* source) {
  put_member(out, "{\"clearance\":", region.clearance);
  out.put(",\"parent\":");
  region.parent == no_region ? out.put("null") : out.put(region.parent);
  if (source != nullptr) {
    out.put(",\"features\":");
    put_list(out, source->features, [&](std::uint32_t feature) { out.put(feature); });
    out.put(",\"attributes\":");
    put_attributes(out, source->attributes);
  }
  out.put(",\"rings\":");
  put_list(out, region.rings, [&](const Ring& ring) { put_ring(out, ring); });
  out.put('}');
}

}  // namespace

Status write_json(Target& target, const OffsetsOutput& output) {
  OutputStream& out = *target.out;
  if (target.part.begins) {
    out.put("{\"medial_offsets\":1");
    put_unit(target);
    out.put(",\n\"items\":");
  }
  put_items(out, target.part, output.document.items, [&](const OffsetItem& item) {
    put_member(out, "{\"tolerance\":", item.offsets.tolerance);
    out.put(",\"attributes\":");
    put_attributes(out, item.attributes);
    out.put(",\"regions\":");
    const auto& regions = item.offsets.regions;
    put_lines(out, numbers_below(regions.size()), [&](std::size_t k) {
      put_region(out, regions[k], item.sources.empty() ? nullptr : &item.sources[k]);
    });
    out.put('}');
  });
  return success();
}

}  // namespace medial::io

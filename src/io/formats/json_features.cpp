// Features as JSON.

#include "io/formats/json.h"
#include "io/formats/json_text.h"
#include "medial/query.h"

namespace medial::io {

namespace {

void put_disk(OutputStream& out, const Disk& disk) {
  put_members<double>(out, {{"x", disk.center.x}, {"y", disk.center.y}, {"r", disk.radius}});
  out.put('}');
}

void put_place(OutputStream& out, const AxisPlace& place) {
  put_member(out, "{\"edge\":", place.edge);
  put_member(out, ",\"t\":", place.t);
  put_disk(out, place.disk);
}

void put_section(OutputStream& out, const BoundarySection& section) {
  out.put("{\"from\":");
  put_row(out, section.from.x, section.from.y);
  out.put(",\"to\":");
  put_row(out, section.to.x, section.to.y);
  put_member(out, ",\"length\":", section.length);
  if (section.ring != no_site) {
    put_member(out, ",\"ring\":", section.ring);
    put_member(out, ",\"first_vertex\":", section.first_vertex);
    put_member(out, ",\"last_vertex\":", section.last_vertex);
  }
  out.put('}');
}

void put_run(OutputStream& out, const PrimitiveRun& run) {
  put_member(out, "{\"primitive\":", name_of(run.primitive));
  put_member(out, ",\"variation\":", name_of(run.variation));
  put_members<double>(out, {{"length", run.length},
                            {"mean_width", 2 * run.mean_radius},
                            {"slope", run.slope},
                            {"bend", run.bend},
                            {"turning", run.turning},
                            {"spiral", run.spiral}});
  out.put(",\"from\":");
  put_place(out, run.from);
  out.put(",\"to\":");
  put_place(out, run.to);
  out.put('}');
}

void put_branch(OutputStream& out, const BranchFeatures& branch, const AxisFeatures& features) {
  put_member(out, "{\"branch\":", branch.branch);
  put_members<bool>(out, {{"reversed", branch.reversed}, {"closed", branch.closed}});
  put_member(out, ",\"from\":", branch.from);
  put_member(out, ",\"from_kind\":", name_of(branch.from_kind));
  put_member(out, ",\"to\":", branch.to);
  put_member(out, ",\"to_kind\":", name_of(branch.to_kind));
  put_members<double>(out, {{"length", branch.length},
                            {"smallest_radius", branch.smallest_radius},
                            {"largest_radius", branch.largest_radius},
                            {"mean_width", branch.mean_width},
                            {"turning", branch.turning},
                            {"absolute_turning", branch.absolute_turning},
                            {"area", branch.area},
                            {"significance", branch.significance}});
  out.put(",\"left\":");
  put_section(out, branch.side[0]);
  out.put(",\"right\":");
  put_section(out, branch.side[1]);
  out.put(",\"runs\":");
  put_list(out, std::span(features.runs).subspan(branch.first_run, branch.run_count),
           [&](const PrimitiveRun& run) { put_run(out, run); });
  out.put('}');
}

void put_shares(OutputStream& out, const AxisFeatures& item) {
  out.put(",\n\"share\":{");
  const char* separator = "\"";
  for (std::size_t p = 0; p < item.share.size(); ++p)
    for (std::size_t v = 0; v < item.share[p].size(); ++v) {
      if (!(item.share[p][v] > 0)) continue;
      out.put(separator);
      separator = ",\"";
      out.put(name_of(static_cast<Primitive>(p)));
      out.put(' ');
      out.put(name_of(static_cast<Variation>(v)));
      put_member(out, "\":", item.share[p][v]);
    }
}

void put_points(OutputStream& out, const MedialAxis& axis, const AxisFeatures& item) {
  const char* separator = "\n{\"node\":";
  for (std::size_t k = 0; k < item.points.size(); ++k) {
    if (item.points[k] == PointKind::normal) continue;
    put_member(out, separator, k);
    separator = ",\n{\"node\":";
    put_member(out, ",\"kind\":", name_of(item.points[k]));
    put_disk(out, axis.nodes[k].disk);
  }
}

void put_item(OutputStream& out, std::uint64_t feature, const AxisItem& axis,
              const AxisFeatures& item) {
  put_member(out, "{\"feature\":", feature);
  out.put(",\"attributes\":");
  put_attributes(out, axis.attributes);
  put_members<std::uint64_t>(out, {{"components", item.components},
                                   {"cycles", item.cycles},
                                   {"ends", item.ends},
                                   {"branchings", item.branchings},
                                   {"closed_branches", item.closed_branches}});
  put_members<double>(out, {{"length", item.length},
                            {"area", item.area},
                            {"boundary", item.boundary},
                            {"largest_radius", item.largest_radius},
                            {"mean_width", item.mean_width}});
  put_shares(out, item);
  out.put("},\n\"points\":[");
  put_points(out, axis.axis, item);
  out.put("],\n\"branches\":");
  put_lines(out, item.branches, [&](const BranchFeatures& b) { put_branch(out, b, item); });
  out.put('}');
}

}  // namespace

Status write_json(Target& target, const FeaturesOutput& output) {
  target.out->put("{\"medial_features\":1");
  put_unit(target);
  target.out->put(",\n\"items\":[");
  for (std::size_t i = 0; i < output.features.size(); ++i) {
    target.out->put(i == 0 ? "\n" : ",\n");
    put_item(*target.out, output.document.index_of(i), output.document.items[i],
             output.features[i]);
  }
  target.out->put("\n]}\n");
  return success();
}

}  // namespace medial::io

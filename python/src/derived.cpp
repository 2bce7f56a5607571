// Results derived from an axis: shapes, offsets, tool paths, codes, certificates.

#include <cmath>

#include "binding.h"

namespace medial::python {
namespace {

ShapeOf shared(Shape shape) { return {std::make_shared<const Shape>(std::move(shape))}; }

RebuildBy rebuild_from(const std::string& name) {
  if (name == "outline") return RebuildBy::outline;
  if (name == "tangents") return RebuildBy::tangents;
  if (name == "hulls") return RebuildBy::hulls;
  refuse(ErrorCode::invalid_option, "by is 'outline', 'tangents' or 'hulls'");
}

ShapeOf rebuilt(const AxisOf& self, const std::string& by, std::uint64_t points, double chord,
                double corner_angle) {
  const RebuildOptions options{rebuild_from(by), points, chord, corner_angle};
  return shared(value_of(run(self.axis.edges.size(), [&](const std::atomic<bool>*) {
    return rebuild(self.axis, options);
  })));
}

/// One region: its clearance, its parent (-1: none), points and bulges of its rings, and the first
/// point of each ring.
nb::tuple tuple_of(const OffsetRegion& region) {
  std::vector<Vec2> points;
  std::vector<double> bulges;
  std::vector<std::int64_t> begin{0};
  for (const Ring& ring : region.rings) {
    points.insert(points.end(), ring.points.begin(), ring.points.end());
    bulges.insert(bulges.end(), ring.bulges.begin(), ring.bulges.end());
    bulges.resize(points.size());
    begin.push_back(static_cast<std::int64_t>(points.size()));
  }
  const std::int64_t parent = region.parent == no_region ? -1 : std::int64_t{region.parent};
  return nb::make_tuple(region.clearance, parent, rows_of<double>(std::move(points)),
                        array_of(std::move(bulges)), array_of(std::move(begin)), area(region),
                        length(region));
}
nb::list list_of(const Offsets& offsets) {
  nb::list list;
  for (const OffsetRegion& region : offsets.regions) list.append(tuple_of(region));
  return list;
}

nb::list inward(const AxisOf& self, const Values<double>& clearances) {
  return list_of(value_of(run(self.axis.edges.size(), [&](const std::atomic<bool>*) {
    return inward_offsets(self.axis, span_of(clearances));
  })));
}
nb::list offsets_of(const ShapeOf& of, const Values<double>& clearances, int threads) {
  Options options;
  options.threads = threads;
  return list_of(value_of(run(of.shape->points.size(), [&](const std::atomic<bool>* cancel) {
    options.cancel = cancel;
    return offset_curves(*of.shape, span_of(clearances), options);
  })));
}

nb::dict certificate(const AxisOf& self, double tolerance, int samples, double corner_angle,
                     int threads) {
  const VerifyOptions options{tolerance, samples, corner_angle, threads, self.part};
  const Certificate from = run(self.shape->points.size(), [&](const std::atomic<bool>*) {
    return verify(*self.shape, self.axis, options);
  });
  nb::dict result;
  result["passed"] = from.passed;
  result["failures"] = from.failures;
  result["tolerance"] = from.tolerance;
  result["resolution"] = from.resolution;
  result["largest_residual"] = from.largest_residual;
  result["largest_intrusion"] = from.largest_intrusion;
  result["largest_contact_gap"] = from.largest_contact_gap;
  result["largest_uncovered"] = from.largest_uncovered;
  result["shape_area"] = from.shape_area;
  result["disks_area"] = from.disks_area;
  result["worst_legality"] = from.worst_legality;
  result["disks_checked"] = from.disks_checked;
  result["components"] = from.components;
  result["graph_parts"] = from.graph_parts;
  result["holes"] = from.holes;
  result["cycles"] = from.cycles;
  result["convex_corners"] = from.convex_corners;
  result["corners_without_leaf"] = from.corners_without_leaf;
  result["reflex_vertices"] = from.reflex_vertices;
  result["reflex_without_contact"] = from.reflex_without_contact;
  result["worst"] = nb::make_tuple(from.worst.x, from.worst.y);
  return result;
}

nb::dict distance_of(const ShapeOf& a, const ShapeOf& b, int samples) {
  const ShapeDistance from =
      without_lock([&] { return shape_distance(*a.shape, *b.shape, samples); });
  nb::dict result;
  result["area"] = from.area;
  result["other_area"] = from.other_area;
  result["from_first"] = from.from_first;
  result["from_second"] = from.from_second;
  result["hausdorff"] = from.hausdorff();
  result["worst"] = nb::make_tuple(from.worst.x, from.worst.y);
  return result;
}

nb::tuple packed(const AxisOf& self, double error) {
  PackReport report;
  PackOptions options;
  options.error = error;
  const ShapeCode code = value_of(
      without_lock([&] { return encode_axes(std::span(&self.axis, 1), options, &report); }));
  return nb::make_tuple(streams_of(code), report.disks, report.lines, report.quantum);
}
nb::list packed_boundary(const ShapeOf& of, double error) {
  return streams_of(
      value_of(without_lock([&] { return encode_boundary(std::span(of.shape.get(), 1), error); })));
}

std::unique_ptr<AxisOf> unpacked(const std::vector<nb::bytes>& streams) {
  auto axes = value_of(decode_axes(code_of(streams)));
  if (axes.size() != 1) refuse(ErrorCode::unsupported, "the code holds another number of axes");
  RebuildOptions options;
  options.by = RebuildBy::hulls;
  Shape shape = value_of(rebuild(axes.front(), options));
  return share(std::make_shared<const Shape>(std::move(shape)), std::move(axes.front()));
}

/// One row per branch: steepness and bend.
Array<double, 2> legal(const AxisOf& self, int samples) {
  std::vector<std::array<double, 2>> rows;
  for (const Legality& one : without_lock([&] { return legality(self.axis, samples); }))
    rows.push_back({one.steepness, one.bend});
  return rows_of<double>(std::move(rows));
}

/// The boundary's curvature at feet: the first row of each branch, and rows of side (0 left, 1
/// right), disk, foot, curvature, and its derivative along the boundary.
nb::tuple curvatures(const AxisOf& self) {
  std::vector<std::array<double, 8>> rows;
  std::vector<std::int64_t> begin{0};
  without_lock([&] {
    for (const Branch& branch : branches(self.axis)) {
      for (const FootCurvature& at : curvatures_along(self.axis, branch))
        rows.push_back({at.side == Side::left ? 0.0 : 1.0, at.disk.center.x, at.disk.center.y,
                        at.disk.radius, at.foot.x, at.foot.y, at.curvature, at.slope});
      begin.push_back(static_cast<std::int64_t>(rows.size()));
    }
    return 0;
  });
  return nb::make_tuple(rows_of<double>(std::move(rows)), array_of(std::move(begin)));
}

/// Placements of a shape next to another one: angle, mirrored, move, bay, saved, gap.
nb::list nested(const ShapeOf& fixed, const ShapeOf& moving, double gap, bool mirror,
                std::size_t best) {
  nb::list list;
  const auto found = value_of(run(long_work, [&](const std::atomic<bool>*) {
    return nest(*fixed.shape, *moving.shape, gap, mirror, best);
  }));
  for (const Placement& at : found)
    list.append(nb::make_tuple(at.angle, at.mirrored, std::array{at.move.x, at.move.y},
                               std::array{at.bay.x, at.bay.y}, at.saved, at.gap));
  return list;
}

}  // namespace

nb::list streams_of(const ShapeCode& code) {
  nb::list streams;
  for (const auto& stream : code)
    streams.append(nb::bytes(reinterpret_cast<const char*>(stream.data()), stream.size()));
  return streams;
}
ShapeCode code_of(const std::vector<nb::bytes>& streams) {
  ShapeCode code;
  if (streams.size() != code.size()) refuse(ErrorCode::malformed, "a code has four streams");
  for (std::size_t i = 0; i < code.size(); ++i) {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(streams[i].c_str());
    code[i].assign(data, data + streams[i].size());
  }
  return code;
}

void bind_derived(nb::module_& module) {
  module.def("rebuilt", &rebuilt);
  module.def("inward_offsets", &inward);
  module.def("offsets_of", &offsets_of);
  module.def("offset_passes", [](const AxisOf& self, double first, double step) {
    return array_of(value_of(offset_passes(self.axis, first, step)));
  });
  module.def("certificate", &certificate);
  module.def("shape_distance", &distance_of);
  module.def("packed", &packed);
  module.def("packed_boundary", &packed_boundary);
  module.def("unpacked", &unpacked);
  module.def("legality", &legal);
  module.def("curvatures", &curvatures);
  module.def("nested", &nested);
  module.def("placed", [](const ShapeOf& self, double angle, bool mirrored,
                          const std::array<double, 2>& move) {
    Placement at;
    at.angle = angle;
    at.mirrored = mirrored;
    at.move = {move[0], move[1]};
    return shared(value_of(placed(*self.shape, at)));
  });
  module.def("without_specks", [](const ShapeOf& self, double share) {
    return shared(without_specks(*self.shape, share));
  });
  module.def("surroundings", [](const ShapeOf& self, double margin) {
    return shared(value_of(surroundings(*self.shape, margin)));
  });
}

}  // namespace medial::python

// The parts of a shape, and the similarity of two shapes.

#include "binding.h"

namespace medial::python {
namespace {

/// A table as columns.
class Columns {
 public:
  template <class Rows, class Value>
  Columns& add(const char* name, const Rows& rows, const Value& value) {
    std::vector<std::decay_t<decltype(value(rows.front()))>> column;
    for (const auto& row : rows) column.push_back(value(row));
    table_[name] = array_of(std::move(column));
    return *this;
  }
  template <class Rows, class Name>
  Columns& add_names(const char* name, const Rows& rows, const Name& name_in) {
    nb::list column;
    for (const auto& row : rows) column.append(nb::str(name_in(row)));
    table_[name] = column;
    return *this;
  }
  nb::dict table() const { return table_; }

 private:
  nb::dict table_;
};

nb::dict branch_table(const std::vector<BranchFeatures>& rows) {
  using Row = BranchFeatures;
  return Columns()
      .add("branch", rows, [](const Row& r) { return r.branch; })
      .add("node_from", rows, [](const Row& r) { return r.from; })
      .add("node_to", rows, [](const Row& r) { return r.to; })
      .add_names("from_kind", rows, [](const Row& r) { return name_of(r.from_kind); })
      .add_names("to_kind", rows, [](const Row& r) { return name_of(r.to_kind); })
      .add("closed", rows, [](const Row& r) { return std::uint8_t{r.closed}; })
      .add("length", rows, [](const Row& r) { return r.length; })
      .add("radius_min", rows, [](const Row& r) { return r.smallest_radius; })
      .add("radius_max", rows, [](const Row& r) { return r.largest_radius; })
      .add("mean_width", rows, [](const Row& r) { return r.mean_width; })
      .add("turning", rows, [](const Row& r) { return r.turning; })
      .add("absolute_turning", rows, [](const Row& r) { return r.absolute_turning; })
      .add("area", rows, [](const Row& r) { return r.area; })
      .add("significance", rows, [](const Row& r) { return r.significance; })
      .table();
}

nb::dict run_table(const std::vector<PrimitiveRun>& rows) {
  using Row = PrimitiveRun;
  return Columns()
      .add_names("primitive", rows, [](const Row& r) { return name_of(r.primitive); })
      .add_names("variation", rows, [](const Row& r) { return name_of(r.variation); })
      .add("length", rows, [](const Row& r) { return r.length; })
      .add("mean_radius", rows, [](const Row& r) { return r.mean_radius; })
      .add("slope", rows, [](const Row& r) { return r.slope; })
      .add("bend", rows, [](const Row& r) { return r.bend; })
      .add("turning", rows, [](const Row& r) { return r.turning; })
      .add("x_from", rows, [](const Row& r) { return r.from.disk.center.x; })
      .add("y_from", rows, [](const Row& r) { return r.from.disk.center.y; })
      .add("radius_from", rows, [](const Row& r) { return r.from.disk.radius; })
      .add("x_to", rows, [](const Row& r) { return r.to.disk.center.x; })
      .add("y_to", rows, [](const Row& r) { return r.to.disk.center.y; })
      .add("radius_to", rows, [](const Row& r) { return r.to.disk.radius; })
      .table();
}

nb::dict described(const AxisOf& self, const std::array<double, 6>& thresholds) {
  const auto [parallel, even, bend, turn, spiral, shortest] = thresholds;
  const FeatureOptions options{parallel, even, bend, turn, spiral, shortest};
  const AxisFeatures from = without_lock([&] { return describe(self.axis, options); });
  nb::dict result;
  result["ends"] = from.ends;
  result["branchings"] = from.branchings;
  result["closed_branches"] = from.closed_branches;
  result["components"] = from.components;
  result["cycles"] = from.cycles;
  result["length"] = from.length;
  result["area"] = from.area;
  result["boundary"] = from.boundary;
  result["largest_radius"] = from.largest_radius;
  result["mean_width"] = from.mean_width;
  result["branches"] = branch_table(from.branches);
  result["runs"] = run_table(from.runs);
  return result;
}

ShapeSignature signature_for(const ShapeOf& of, int threads) {
  Options options;
  options.threads = threads;
  return value_of(run(of.shape->points.size(), [&](const std::atomic<bool>* cancel) {
    options.cancel = cancel;
    auto axis = compute(without_specks(*of.shape), options);
    return axis ? Result<ShapeSignature>(signature_of(*axis, describe(*axis)))
                : Result<ShapeSignature>(std::move(axis).error());
  }));
}

}  // namespace

void bind_features(nb::module_& module) {
  nb::class_<ShapeSignature>(module, "Signature");
  module.def("described", &described);
  module.def("signature_of", &signature_for);
  module.def("dissimilarity", &dissimilarity);
}

}  // namespace medial::python

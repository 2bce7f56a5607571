// Operations on many features at once, from rings to numbers, without a Python object per feature.

#include <cmath>
#include <functional>
#include <limits>

#include "faces/axes.h"
#include "many.h"

namespace medial::python {
namespace {

/// The result of an operation for features: rows of numbers and levels of offsets. The first
/// offsets group rows into parts, the next ones group these parts, and so on up to the features.
/// Attributes belong to the parts of the first level.
struct Table {
  std::size_t columns = 0;
  std::vector<double> values, attributes;
  std::vector<std::vector<std::int64_t>> begin;
  FeatureErrors errors;

  Table(std::size_t some_columns, std::size_t levels)
      : columns(some_columns), begin(levels, std::vector<std::int64_t>{0}) {}

  void add(std::initializer_list<double> row) { values.insert(values.end(), row); }
  void add(const Disk& disk) { add({disk.center.x, disk.center.y, disk.radius}); }
  /// Ends a part of a level. Parts of level 0 consist of rows.
  void end(std::size_t level) {
    const std::size_t size = level == 0 ? values.size() / columns : begin[level - 1].size() - 1;
    begin[level].push_back(static_cast<std::int64_t>(size));
  }
  void append_all(Table& part) {
    append(values, part.values);
    append(attributes, part.attributes);
    for (std::size_t level = 0; level < begin.size(); ++level)
      append_offsets(begin[level], part.begin[level]);
    append(errors, part.errors);
  }
};

/// Appends the result for a shape. If it fails, it appends nothing.
using Work = std::function<Status(const Shape&, const Options&, Table&)>;
struct Operation {
  Table empty;
  Work work;
};

/// The options of an operation, by name.
class Given {
 public:
  explicit Given(const nb::dict& from) : from_(from) {}
  template <class T>
  T get(const char* name) const {
    return option_as<T>(from_[name], name);
  }

 private:
  const nb::dict& from_;
};

/// The largest distance of lines from curves: a share of a shape's diagonal, or in units of the
/// input.
struct Chord {
  double share, absolute;
  explicit Chord(const Given& given)
      : share(given.get<double>("share")),
        absolute(given.get<std::optional<double>>("chord").value_or(0)) {
    if (!(absolute >= 0)) refuse(ErrorCode::invalid_option, "chord must be at least 0");
  }
  double of(const Shape& shape) const {
    const double chord = absolute > 0 ? absolute : share * diagonal(bounding_box(shape));
    return chord > 0 ? chord : 1;
  }
};

Result<AxisPath> longest_path(const MedialAxis& axis, const MainPathOptions& options) {
  std::vector<AxisPath> paths = main_paths(axis, options);
  if (paths.empty()) return Error{ErrorCode::empty, "the axis has no edge", {}};
  return std::move(*std::ranges::max_element(paths, {}, &AxisPath::length));
}

MainPathOptions main_path_options(const Given& given) {
  return {length_as(given.get<double>("trim"), "trim"),
          route_from(given.get<std::string>("route"))};
}

/// One line per feature: rows of x, y, radius.
Operation centerlines(const Given& given) {
  const CentreLineOptions line_options{given.get<bool>("extend"),
                                       length_as(given.get<double>("smooth"), "smooth")};
  const auto work = [=, chord = Chord(given), path_options = main_path_options(given)](
                        const Shape& shape, const Options& options, Table& table) -> Status {
    const auto axis = compute(shape, options);
    if (!axis) return axis.error();
    const auto path = longest_path(*axis, path_options);
    if (!path) return path.error();
    std::vector<Disk> disks;
    std::vector<std::int64_t> begin{0};
    add_lines(centre_line(shape, *axis, *path, line_options), chord.of(shape), 0, disks, begin);
    for (const Disk& disk : disks) table.add(disk);
    return success();
  };
  return {Table(3, 1), work};
}

/// One row per feature: the mean, the least and the largest width along the centre line, and its
/// length.
Operation widths(const Given& given) {
  const auto samples = given.get<std::size_t>("samples");
  if (samples == 0) refuse(ErrorCode::invalid_option, "samples must be at least 1");
  const auto work = [samples, path_options = main_path_options(given)](
                        const Shape& shape, const Options& options, Table& table) -> Status {
    const auto axis = compute(shape, options);
    if (!axis) return axis.error();
    const auto path = longest_path(*axis, path_options);
    if (!path) return path.error();
    std::vector<double> places(samples, 0);
    for (std::size_t i = 1; i < samples; ++i)
      places[i] = path->length * (static_cast<double>(i) / static_cast<double>(samples - 1));
    double sum = 0, largest = 0;
    const std::vector<LocalWidth> found = widths_along(*axis, *path, places);
    for (std::size_t i = 0; i < samples; ++i) {
      const double width = 2 * found[i].disk.radius;
      const bool inner = samples == 1 || (i > 0 && i + 1 < samples);
      sum += inner ? width : width / 2;
      largest = std::max(largest, width);
    }
    const double parts = samples == 1 ? 1 : static_cast<double>(samples - 1);
    table.add({sum / parts, 2 * path->narrowest, largest, path->length});
    return success();
  };
  return {Table(4, 0), work};
}

/// Rows of x, y, radius.
Operation circles(const Given& given) {
  const auto count = given.get<std::size_t>("count");
  const auto smallest = given.get<double>("smallest");
  return {Table(3, 1), [=](const Shape& shape, const Options&, Table& table) -> Status {
            for (const Disk& disk : largest_disjoint_disks(shape, count, smallest)) table.add(disk);
            return success();
          }};
}

/// Polygons of rings of x, y.
Operation offsets(const Given& given) {
  const auto distance = given.get<double>("distance");
  const auto work = [distance, chord = Chord(given)](const Shape& shape, const Options& options,
                                                     Table& table) -> Status {
    const auto found = offset_curves(shape, std::span(&distance, 1), options);
    if (!found) return found.error();
    std::vector<Vec2> points;
    for (const OffsetRegion& region : found->regions) {
      for (const Ring& ring : region.rings) {
        points.clear();
        faces::add_outline(ring, chord.of(shape), points);
        for (const Vec2 p : points) table.add({p.x, p.y});
        table.end(0);
      }
      table.end(1);
    }
    return success();
  };
  return {Table(2, 3), work};
}

/// One line per branch: rows of x, y, radius.
Operation pruned(const Given& given) {
  const PruneOptions prune_options{measure_from(given.get<std::string>("measure")),
                                   given.get<std::optional<double>>("threshold"),
                                   given.get<std::optional<std::uint64_t>>("keep"),
                                   given.get<bool>("tips")};
  const auto work = [=, chord = Chord(given)](const Shape& shape, const Options& options,
                                              Table& table) -> Status {
    const auto axis = compute(shape, options);
    if (!axis) return axis.error();
    const auto kept = prune(*axis, prune_options);
    if (!kept) return kept.error();
    std::vector<Disk> disks;
    std::vector<std::int64_t> begin{0};
    add_lines(*kept, chord.of(shape), 0, disks, begin);
    for (std::size_t line = 0; line + 1 < begin.size(); ++line) {
      for (auto i = begin[line]; i < begin[line + 1]; ++i)
        table.add(disks[static_cast<std::size_t>(i)]);
      table.end(0);
    }
    return success();
  };
  return {Table(3, 2), work};
}

/// One line per branch: rows of x, y, radius; with the numbers of features() for the branch.
Operation branch_tables(const Given& given) {
  const auto work = [chord = Chord(given)](const Shape& shape, const Options& options,
                                           Table& table) -> Status {
    const auto axis = compute(shape, options);
    if (!axis) return axis.error();
    std::vector<Disk> disks;
    std::vector<std::int64_t> begin{0};
    add_lines(*axis, chord.of(shape), 0, disks, begin);
    for (const BranchFeatures& one : describe(*axis).branches) {
      const Node &from = axis->nodes[one.from], &to = axis->nodes[one.to];
      for (auto i = begin[one.branch]; i < begin[one.branch + 1]; ++i)
        table.add(disks[static_cast<std::size_t>(i)]);
      table.end(0);
      const double row[] = {double(one.branch),
                            double(one.from),
                            double(one.to),
                            double(one.from_kind),
                            double(one.to_kind),
                            double(one.closed),
                            one.length,
                            one.smallest_radius,
                            one.largest_radius,
                            one.mean_width,
                            one.turning,
                            one.absolute_turning,
                            one.area,
                            one.significance,
                            distance(from.disk.center, to.disk.center),
                            double(from.component)};
      table.attributes.insert(table.attributes.end(), std::begin(row), std::end(row));
    }
    return success();
  };
  return {Table(3, 2), work};
}

/// Lines of two rows of x, y, across the centre line; with the position along it, the width, and
/// the length.
Operation transects(const Given& given) {
  const auto count = given.get<std::size_t>("count");
  const auto work = [count, path_options = main_path_options(given)](
                        const Shape& shape, const Options& options, Table& table) -> Status {
    const auto axis = compute(shape, options);
    if (!axis) return axis.error();
    const auto path = longest_path(*axis, path_options);
    if (!path) return path.error();
    std::vector<double> places(count);
    for (std::size_t i = 0; i < count; ++i)
      places[i] = path->length * ((static_cast<double>(i) + 0.5) / static_cast<double>(count));
    for (const LocalWidth& at : transects_along(shape, *axis, *path, places)) {
      for (const Vec2 end : at.feet) table.add({end.x, end.y});
      table.end(0);
      const double row[] = {at.along, at.width(), at.span()};
      table.attributes.insert(table.attributes.end(), std::begin(row), std::end(row));
    }
    return success();
  };
  return {Table(2, 2), work};
}

Operation operation_from(const std::string& name, const Given& given) {
  if (name == "centerline") return centerlines(given);
  if (name == "width") return widths(given);
  if (name == "inscribed_circles") return circles(given);
  if (name == "offset") return offsets(given);
  if (name == "prune") return pruned(given);
  if (name == "branches") return branch_tables(given);
  if (name == "transects") return transects(given);
  refuse(ErrorCode::invalid_option, "there is no such operation");
}

/// Appends the results of the operation for features [first, last).
void add_range(const Features& features, std::size_t first, std::size_t last,
               const Options& options, const Operation& operation, Table& table) {
  std::vector<Ring> rings;
  const std::size_t levels = table.begin.size();
  for (std::size_t i = first; i < last && !*options.cancel; ++i) {
    features.rings(i, rings);
    auto shape = build_shape(rings);
    Status done = shape ? operation.work(*shape, options, table) : std::move(shape).error();
    if (!done) {
      done.error().place.feature = i;
      table.errors.emplace_back(static_cast<std::int64_t>(i), std::move(done).error());
      if (levels == 0)
        table.values.resize(table.values.size() + table.columns,
                            std::numeric_limits<double>::quiet_NaN());
    }
    if (levels > 0) table.end(levels - 1);
  }
}

nb::tuple each_of(const Coordinates& coordinates, const Values<std::int64_t>& ring,
                  const Values<std::int64_t>& polygon,
                  const std::optional<Values<std::int64_t>>& feature,
                  const std::optional<Values<double>>& bulges, const Options& options,
                  const std::string& name, const nb::dict& given, const nb::object& progress) {
  const Features features = features_of(coordinates, ring, polygon, feature, bulges);
  const Operation operation = operation_from(name, Given(given));
  std::vector<Table> parts((features.count() + block - 1) / block, operation.empty);
  for_each_block(features, options, progress,
                 [&](std::size_t first, std::size_t last, const Options& own) {
                   add_range(features, first, last, own, operation, parts[first / block]);
                 });
  Table all = operation.empty;
  without_lock([&] {
    for (Table& part : parts) all.append_all(part);
    return 0;
  });
  nb::list levels;
  for (auto& level : all.begin) levels.append(array_of(std::move(level)));
  return nb::make_tuple(array_of(std::move(all.values)), all.columns, levels, list_of(all.errors),
                        array_of(std::move(all.attributes)));
}

}  // namespace

void bind_batches(nb::module_& module) {
  module.def("each_of", &each_of, nb::arg("coordinates"), nb::arg("ring"), nb::arg("polygon"),
             nb::arg("feature").none(), nb::arg("bulges").none(), nb::arg("options"),
             nb::arg("operation"), nb::arg("given"), nb::arg("progress").none());
}

}  // namespace medial::python

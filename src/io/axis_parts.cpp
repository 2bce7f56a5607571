// Axes that are written while they grow.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "axis/statistics.h"
#include "io/attribute_columns.h"
#include "io/axis_writer.h"
#include "io/format_name.h"
#include "io/part_writer.h"
#include "io/place.h"
#include "io/tables.h"
#include "io/whole_branches.h"
#include "io/write_target.h"
#include "medial/document.h"
#include "medial/query.h"
#include "methods/problem.h"

namespace medial::io {

namespace {

/// A shape with the same bounding box, by which chords are chosen.
Shape stand_in(const Shape& shape) {
  const Box box = bounding_box(shape);
  Shape four;
  four.points = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  four.sources.resize(four.points.size());
  four.loop_begin = {0, 4};
  four.component = {0};
  four.hole = {false};
  return four;
}

/// Axes by a writer of tables or texts that takes items in parts.
class RowsOfAxes final : public AxisWriter {
 public:
  RowsOfAxes(const Document<ShapeItem>& shapes, const WriteOptions& write, bool by_branches,
             PartWriter& writer)
      : shapes_(shapes),
        write_(write),
        by_branches_(by_branches),
        writer_(writer),
        made_{shapes, {}} {}

  Status begin() override {
    if (Status framed = put_beginning(); !framed) return framed;
    const ShapeItem& shape = shapes_.items[begun_];
    made_.items.assign(1, AxisItem{stand_in(shape.shape), {}, shape.attributes});
    made_.indices = {shapes_.index_of(begun_)};
    numbers_.feature = begun_++;
    numbers_.branch = 0;
    nodes_ = 0;
    return success();
  }
  Status add(AxisPart&& part) override {
    nodes_ += part.axis.nodes.size() - part.known;
    if (!by_branches_) return put_part(std::move(part));
    branches_.add(part);
    return branches_.is_full() ? put_part(branches_.take()) : success();
  }
  Status end(const Statistics&) override {
    Status done = by_branches_ ? put_part(branches_.take()) : success();
    branches_ = {};
    numbers_.node += nodes_;
    return done;
  }
  Status finish() override {
    if (Status framed = put_beginning(); !framed) return framed;
    made_.items.clear();
    Status ended = put({false, true});
    return ended ? writer_.finish() : ended;
  }

 private:
  /// What stands before the first shape.
  Status put_beginning() { return begun_ == 0 ? put({true, false}) : success(); }
  Status put_part(AxisPart&& part) {
    MedialAxis& axis = made_.items[0].axis;
    axis = std::move(part.axis);
    numbers_.nodes = part.nodes;
    Status done = put(numbers_);
    numbers_.edge += axis.edges.size();
    numbers_.branch += branch_count(axis);
    numbers_.nodes = {};
    return done;
  }
  Status put(const Part& numbers) {
    auto prepared = writer_.prepare(AxesOutput{made_, write_}, numbers);
    return prepared ? writer_.add(prepared->get()) : Status(std::move(prepared).error());
  }

  const Document<ShapeItem>& shapes_;
  const WriteOptions& write_;
  bool by_branches_;
  PartWriter& writer_;
  Document<AxisItem> made_;  ///< the part that is being written
  Part numbers_{false, false};
  WholeBranches branches_;
  std::uint64_t nodes_ = 0;
  std::size_t begun_ = 0;
};

/// Computes the axes of a document's shapes one after another, and hands out their parts.
class PartsOfAxes {
 public:
  PartsOfAxes(Document<ShapeItem> shapes, const AxesOptions& options, const PartVisitor& visit)
      : shapes_(std::move(shapes)), options_(options), visit_(visit) {
    for (const ShapeItem& item : shapes_.items)
      all_points_ += static_cast<double>(item.shape.points.size());
  }

  /// Writes all parts. `take_again()` where the walk of one shape restarts or ends in an error that
  /// leaves the shape out, which makes void what has been written: then everything is to be written
  /// again.
  Status write_all(AxisWriter& writer) {
    done_points_ = 0;
    report_ = {};
    for (std::size_t i = 0; i < shapes_.items.size();) {
      const std::size_t left = shapes_.items.size();
      if (Status written = write_item(i, writer); !written) return written;
      if (shapes_.items.size() == left) ++i;
    }
    report_.left_out = left_out_;
    return writer.finish();
  }
  bool take_again() { return std::exchange(again_, false); }
  const std::optional<Error>& own_error() const { return own_error_; }
  const AxesReport& report() const { return report_; }
  const Document<ShapeItem>& shapes() const { return shapes_; }  ///< those that are not left out

 private:
  Status write_item(std::size_t i, AxisWriter& writer) {
    again_ = false;
    bool begun = false;
    const auto take = [&](AxisPart&& part) -> Status {
      if (part.begins && std::exchange(begun, true)) return begin_again(i, std::move(part));
      if (part.begins)
        if (Status ready = writer.begin(); !ready) return ready;
      if (visit_) visit_(i, shapes_.index_of(i), part);
      return writer.add(std::move(part));
    };
    Statistics statistics;
    Status done = success();
    if (const auto whole = whole_.find(shapes_.index_of(i)); whole != whole_.end()) {
      statistics = whole->second.axis.statistics;
      done = take(AxisPart(whole->second));
    } else {
      done = compute(i, take, statistics);
    }
    done_points_ += static_cast<double>(shapes_.items[i].shape.points.size());
    if (own_error_ &&
        leave_out_feature(*own_error_, options_.skip_invalid ? &left_out_ : nullptr)) {
      own_error_.reset();
      drop(i);
      again_ = begun;
      return begun ? done : success();
    }
    if (!done) return done;
    report_.statistics += statistics;
    if (visit_) report_.sites += Problem(shapes_.items[i].shape, options_).numbers().count;
    return writer.end(statistics);
  }

  void drop(std::size_t i) {
    std::vector<std::size_t> others(shapes_.items.size());
    std::iota(others.begin(), others.end(), std::size_t{0});
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    shapes_.keep(others);
  }

  Status compute(std::size_t i, const AxisSink& take, Statistics& statistics) {
    const Shape& shape = shapes_.items[i].shape;
    Options own = options_;
    if (own.progress)
      own.progress = [&, size = static_cast<double>(shape.points.size())](double share) {
        options_.progress((done_points_ + share * size) / all_points_);
      };
    bool taken = true;
    const auto rest = compute_in_parts(shape, own, [&](AxisPart&& part) {
      Status done = take(std::move(part));
      taken = done.ok();
      return done;
    });
    if (rest) {
      statistics = rest->statistics;
      return success();
    }
    Error error = rest.error();
    if (!taken) return error;
    error.place.feature = shapes_.index_of(i);
    own_error_ = error;
    return error;
  }

  /// The parts of this shape are void: the new one is the whole axis.
  Status begin_again(std::size_t i, AxisPart&& part) {
    again_ = true;
    whole_.emplace(shapes_.index_of(i), std::move(part));
    return Error{ErrorCode::internal, "the walk has restarted: please report this shape", {}};
  }

  Document<ShapeItem> shapes_;
  const AxesOptions& options_;
  const PartVisitor& visit_;
  std::vector<std::string> left_out_;
  double done_points_ = 0, all_points_ = 0;
  bool again_ = false;
  std::map<std::uint64_t, AxisPart> whole_;  ///< axes whose walk has restarted, by their features
  std::optional<Error> own_error_;           ///< of computing
  AxesReport report_;
};

/// Takes axes in a run that writes nothing.
class NoAxes final : public AxisWriter {
 public:
  Status begin() override { return success(); }
  Status add(AxisPart&&) override { return success(); }
  Status end(const Statistics&) override { return success(); }
  Status finish() override { return success(); }
};

/// Writes all of a file once.
Status write_once(PartsOfAxes& parts, Target& to, const Format& format, const GrowingFrame& frame,
                  const WriteOptions& write) {
  if (format.growing == Growing::graph) return parts.write_all(*format.grow(to, frame));
  auto columns = std::make_shared<AttributeColumns>();
  for (const ShapeItem& item : frame.shapes.items) columns->add(item.attributes);
  const Document<AxisItem> none{frame.shapes, {}};
  const AxesOutput output{none, write};
  columns->finish(frame.shapes, own_columns(output));
  to.columns = std::move(columns);
  auto writer = writer_of_parts(to, format, output);
  if (!writer) return std::move(writer).error();
  RowsOfAxes rows(frame.shapes, write, format.growing == Growing::branches, **writer);
  return parts.write_all(rows);
}

/// Where what waits to be written has room.
Result<std::string> folder_of(const Destination& target) {
  if (target.text != nullptr) return temporary_folder();
  return std::filesystem::weakly_canonical(target.path).parent_path().string();
}

/// Whether a format is written while axes grow. What has gone to a pipe cannot be taken back where
/// the walk begins again; sites are known beforehand where the axis comes in parts.
bool can_grow(const Destination& target, const Format* format, const Document<ShapeItem>& shapes,
              const Options& options) {
  if (format == nullptr || format->growing == Growing::none) return false;
  if (is_stream(target.path) && target.text == nullptr) return false;
  return format->growing != Growing::graph ||
         std::ranges::all_of(shapes.items, [&](const ShapeItem& item) {
           return comes_in_parts(item.shape, options);
         });
}

}  // namespace

void take_whole_numbers(AxisPart& part) {
  MedialAxis& axis = part.axis;
  for (Edge& edge : axis.edges) {
    for (std::uint32_t& node : edge.node) node = part.nodes[node];
    for (std::uint32_t& site : edge.site)
      if (site != no_site) site = part.sites[site];
  }
  axis.nodes.erase(axis.nodes.begin(),
                   axis.nodes.begin() + static_cast<std::ptrdiff_t>(part.known));
}

Result<std::optional<AxesReport>> write_in_parts(
    const Destination& target, const std::string& format, Document<ShapeItem>&& shapes,
    const AxesOptions& options, const WriteOptions& write, const PartVisitor& visit) {
  constexpr DocumentKind axes = DocumentKind::axes;
  const bool silent = target.path.empty();
  if (!silent) {
    const auto row = find_format(format_name(target.path, format), axes);
    if (!row) return Error{row.error().code, row.error().text, in_file(target.path)};
    if (!can_grow(target, *row, shapes, options)) return std::optional<AxesReport>();
  }
  if (!(write.chord > 0) || !std::isfinite(write.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", {}};
  const DocumentInfo info = shapes;
  PartsOfAxes parts(std::move(shapes), options, visit);
  NoAxes none;
  const auto write_file = [&]() -> Status {
    if (silent) return parts.write_all(none);
    Result<std::string> folder = folder_of(target);
    if (!folder) return std::move(folder).error();
    const GrowingFrame frame{parts.shapes(), options, *std::move(folder)};
    return write_target(
        target, format,
        {axes, "json", "medial", info.crs_wkt, info.unit, write.overwrite, write.layer},
        [&](Target& to, const Format& chosen) {
          return write_once(parts, to, chosen, frame, write);
        });
  };
  Status done = write_file();
  while (!done && parts.take_again()) done = write_file();
  if (parts.own_error()) return *parts.own_error();
  if (!done) return std::move(done).error();
  return std::optional(parts.report());
}

}  // namespace medial::io

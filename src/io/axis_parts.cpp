// Axes that are written while they grow.

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "axis/statistics.h"
#include "io/attribute_columns.h"
#include "io/format_name.h"
#include "io/part_writer.h"
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

/// Computes the axes of a document's shapes one after another, and writes their parts.
class PartsOfAxes {
 public:
  PartsOfAxes(const Document<ShapeItem>& shapes, const Options& options, const WriteOptions& write,
              const PartVisitor& visit)
      : shapes_(shapes), options_(options), write_(write), visit_(visit), made_{shapes, {}} {
    for (const ShapeItem& item : shapes.items)
      all_points_ += static_cast<double>(item.shape.points.size());
  }

  /// Writes all parts. `take_again()` where the walk of one shape restarts, which makes void what
  /// has been written: then everything is to be written again.
  Status write_all(PartWriter& writer, bool by_branches) {
    numbers_ = {false, false};
    done_points_ = 0;
    report_ = {};
    if (Status begun = put({true, false}, writer); !begun) return begun;
    for (std::size_t i = 0; i < shapes_.items.size(); ++i)
      if (Status written = write_item(i, writer, by_branches); !written) return written;
    if (Status ended = put({false, true}, writer); !ended) return ended;
    return writer.finish();
  }
  bool take_again() { return std::exchange(again_, false); }
  const std::optional<Error>& own_error() const { return own_error_; }
  const AxesReport& report() const { return report_; }
  /// What stands in front of the first part.
  const Document<AxisItem>& frame() const { return made_; }

 private:
  Status write_item(std::size_t i, PartWriter& writer, bool by_branches) {
    const ShapeItem& shape = shapes_.items[i];
    made_.items.assign(1, AxisItem{stand_in(shape.shape), {}, shape.attributes});
    made_.indices = {shapes_.index_of(i)};
    numbers_.feature = i;
    numbers_.branch = 0;
    again_ = false;
    bool begun = false;
    std::uint64_t nodes = 0;
    WholeBranches branches;
    const auto take = [&](AxisPart&& part) -> Status {
      if (part.begins && std::exchange(begun, true)) return begin_again(i, std::move(part));
      if (visit_) visit_(i, part);
      nodes += part.axis.nodes.size() - part.known;
      if (!by_branches) return put_part(std::move(part), writer);
      branches.add(part);
      return branches.is_full() ? put_part(branches.take(), writer) : success();
    };
    const auto whole = whole_.find(i);
    const bool is_known = whole != whole_.end();
    if (is_known) count(i, whole->second.axis.statistics);
    Status done = is_known ? take(AxisPart(whole->second)) : compute(i, take);
    if (done && by_branches) done = put_part(branches.take(), writer);
    numbers_.node += nodes;
    done_points_ += static_cast<double>(shape.shape.points.size());
    made_.items.clear();
    return done;
  }

  Status compute(std::size_t i, const AxisSink& take) {
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
      count(i, rest->statistics);
      return success();
    }
    Error error = rest.error();
    if (!taken) return error;
    error.place.feature = shapes_.index_of(i);
    own_error_ = error;
    return error;
  }

  void count(std::size_t i, const Statistics& statistics) {
    report_.statistics += statistics;
    if (visit_) report_.sites += Problem(shapes_.items[i].shape, options_).numbers().count;
  }

  /// The parts of this shape are void: the new one is the whole axis.
  Status begin_again(std::size_t i, AxisPart&& part) {
    again_ = true;
    whole_.emplace(i, std::move(part));
    return Error{ErrorCode::internal, "the walk has restarted: please report this shape", {}};
  }

  Status put_part(AxisPart&& part, PartWriter& writer) {
    MedialAxis& axis = made_.items[0].axis;
    axis = std::move(part.axis);
    numbers_.nodes = part.nodes;
    Status done = put(numbers_, writer);
    numbers_.edge += axis.edges.size();
    numbers_.branch += branch_count(axis);
    numbers_.nodes = {};
    return done;
  }

  Status put(const Part& numbers, PartWriter& writer) {
    auto prepared = writer.prepare(AxesOutput{made_, write_}, numbers);
    return prepared ? writer.add(prepared->get()) : Status(std::move(prepared).error());
  }

  const Document<ShapeItem>& shapes_;
  const Options& options_;
  const WriteOptions& write_;
  const PartVisitor& visit_;
  Document<AxisItem> made_;  ///< the part that is being written
  Part numbers_{false, false};
  double done_points_ = 0, all_points_ = 0;
  bool again_ = false;
  std::map<std::size_t, AxisPart> whole_;  ///< axes whose walk has restarted
  std::optional<Error> own_error_;         ///< of computing
  AxesReport report_;
};

}  // namespace

Result<std::optional<AxesReport>> write_in_parts(const Destination& target,
                                                 const std::string& format,
                                                 const Document<ShapeItem>& shapes,
                                                 const Options& options, const WriteOptions& write,
                                                 const PartVisitor& visit) {
  const bool silent = target.path.empty();
  const std::string extension = format_name(target.path, format);
  const bool by_branches = !silent && extension != "csv";
  const Format* row = silent ? nullptr : find_format(extension, DocumentKind::axes);
  // What has gone to a pipe cannot be taken back where the walk begins again. Other tables have the
  // nodes as well, and other texts an item at a time.
  const bool is_text = extension == "csv" || extension == "geojson";
  if (!silent && (row == nullptr || (is_stream(target.path) && target.text == nullptr) ||
                  !(is_text || extension == "fgb" || extension == "shp")))
    return std::optional<AxesReport>();
  if (!(write.chord > 0) || !std::isfinite(write.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", {}};
  PartsOfAxes parts(shapes, options, write, visit);
  const auto write_once = [&]() -> Status {
    if (silent) return parts.write_all(*writer_of_nothing(), by_branches);
    const auto put = [&](Target& to, const Format& chosen) -> Status {
      auto columns = std::make_shared<AttributeColumns>();
      for (const ShapeItem& item : shapes.items) columns->add(item.attributes);
      const AxesOutput frame{parts.frame(), write};
      columns->name_apart(own_columns(frame));
      to.columns = std::move(columns);
      auto writer = writer_of_parts(to, chosen, frame);
      return writer ? parts.write_all(**writer, by_branches) : Status(std::move(writer).error());
    };
    return write_target(target, format,
                        {DocumentKind::axes, "json", "medial", shapes.crs_wkt, shapes.unit,
                         write.overwrite, write.layer},
                        put);
  };
  Status done = write_once();
  while (!done && parts.take_again()) done = write_once();
  if (parts.own_error()) return *parts.own_error();
  if (!done) return std::move(done).error();
  return std::optional(parts.report());
}

}  // namespace medial::io

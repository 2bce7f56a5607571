#include <fmt/format.h>
#include <sys/stat.h>

#include <atomic>

#include "axis/statistics.h"
#include "base/counted.h"
#include "base/in_flight.h"
#include "base/pipeline.h"
#include "io/attribute_columns.h"
#include "io/checks.h"
#include "io/degrees.h"
#include "io/format.h"
#include "io/format_name.h"
#include "io/open.h"
#include "io/part_writer.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "io/tables.h"
#include "io/write_target.h"
#include "medial/io/write.h"
#include "medial/threads.h"

namespace medial::io {

namespace {

constexpr std::size_t points_of_part = 8192;  // some megabytes with their axes
constexpr double long_work = 50'000;          // points that are worth several threads
/// How many parts may wait for a slow one.
std::size_t window_of(int threads) { return 6 + 2 * static_cast<std::size_t>(threads); }

bool is_large_file(const std::string& path, std::uint64_t least) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         static_cast<std::uint64_t>(status.st_size) >= least;
}

bool needs_all_features(const SourceOptions& source) {
  const UnitOptions& units = source.units;
  return source.read.project || source.read.loose || source.read.repair != RepairRule::none ||
         !source.text.empty() || source.load.fit > 0 || source.load.keep_contours ||
         units.given != Unit::unknown || units.wanted != Unit::unknown || units.scale != 1 ||
         units.pixel_size > 0 || units.assumed != Unit::unknown;
}

/// Reads features part by part, and checks them; next() returns nothing where there are no more.
class PartReader {
 public:
  PartReader(FeatureReader& reader, const ReadOptions& options)
      : reader_(reader), checks_(options) {}

  Result<std::optional<Document<Feature>>> next() {
    if (!more_) return std::optional<Document<Feature>>();
    Document<Feature> part;
    const Result<bool> more = reader_.read(points_of_part, part);
    if (!more) return more.error();
    more_ = *more;
    if (Status checked = checks_.check(part); !checked) return std::move(checked).error();
    return std::optional(std::move(part));
  }
  Status finish(Document<Feature>& document) const { return checks_.finish(document); }

 private:
  FeatureReader& reader_;
  FeatureChecks checks_;
  bool more_ = true;
};

/// What has to be known of all features before the first one is written.
struct Survey {
  Document<Feature> common;  ///< without items
  AttributeColumns columns;
  std::uint64_t features = 0;
  double points = 0;
  bool arcs = false;
  bool too_large = false;  ///< a feature has more points than are wanted: the rest is unread
};

Result<Survey> survey_of(PartReader reader, const std::string& crs, std::uint64_t most_points) {
  Survey survey;
  Extremes extremes;
  for (;;) {
    auto part = reader.next();
    if (!part) return std::move(part).error();
    if (!*part) break;
    Document<Feature>& features = **part;
    Document<Feature>& common = survey.common;
    if (!features.crs_wkt.empty()) common.crs_wkt = features.crs_wkt;
    common.geographic = common.geographic || features.geographic;
    if (features.unit != Unit::unknown) common.unit = features.unit;
    if (!features.text_attributes.empty())
      common.text_attributes = std::move(features.text_attributes);
    std::ranges::move(features.notes, std::back_inserter(common.notes));
    extremes.add(features);
    for (const Feature& feature : features.items) {
      survey.too_large = survey.too_large || point_count(feature) > most_points;
      survey.columns.add(feature.attributes);
      survey.points += static_cast<double>(point_count(feature));
      survey.arcs = survey.arcs || std::ranges::any_of(feature.rings, [](const Ring& ring) {
                      return !ring.bulges.empty();
                    });
    }
    survey.features += features.items.size();
    if (survey.too_large) return survey;
  }
  if (Status complete = reader.finish(survey.common); !complete) return std::move(complete).error();
  if (Status settled = settle_crs(survey.common, crs, extremes.reach()); !settled)
    return std::move(settled).error();
  note_stretch(survey.common, extremes);
  return survey;
}

/// A file that is read twice.
struct TwiceRead {
  std::string path;
  const ReadOptions& options;
  std::unique_ptr<FeatureReader> reader = nullptr;
  bool is_unusual = false;

  /// `reader` is null where there is none of its format.
  Status open() {
    auto opened = open_features(path, options, is_unusual);
    if (!opened) return std::move(opened).error();
    reader = std::move(*opened);
    return success();
  }
  Result<Survey> survey(std::uint64_t most_points) {
    return survey_of(PartReader(*reader, options), options.crs, most_points);
  }
  Result<PartReader> again() {
    if (!reader->begin_again())
      if (Status opened = open(); !opened) return std::move(opened).error();
    return PartReader(*reader, options);
  }
};

/// Opens and surveys a file; nothing: it is not to be streamed.
Result<std::optional<Survey>> survey_file(TwiceRead& file, std::uint64_t most_points) {
  const auto survey = [&]() -> Result<std::optional<Survey>> {
    if (Status opened = file.open(); !opened) return std::move(opened).error();
    if (file.reader == nullptr) return std::optional<Survey>();
    auto found = file.survey(most_points);
    if (!found) return std::move(found).error();
    return found->too_large ? std::optional<Survey>() : std::optional(std::move(*found));
  };
  try {
    return survey();
  } catch (const Unusual&) {
    file.is_unusual = true;
    return survey();
  }
}

PartOutput output_of(const Document<AxisItem>& made, const WriteOptions& options) {
  return AxesOutput{made, options};
}
PartOutput output_of(const Document<OffsetItem>& made, const WriteOptions& options) {
  return OffsetsOutput{made, options};
}
PartOutput output_of(const MeasuredItems& made, const WriteOptions& options) {
  return LayersOutput{{made.first, options}, made.second};
}
PartOutput output_of(const StreamItems& made, const WriteOptions& options) {
  return std::visit([&](const auto& own) { return output_of(own, options); }, made);
}

template <class Item>
Document<Item>& features_of(Document<Item>& made) {
  return made;
}
Document<AxisItem>& features_of(MeasuredItems& made) { return made.second; }
DocumentInfo& info_of(StreamItems& made) {
  return std::visit([](auto& own) -> DocumentInfo& { return features_of(own); }, made);
}
/// The same kind of items, none, in a document with this information.
StreamItems without_items(StreamItems none, const DocumentInfo& info) {
  info_of(none) = info;
  if (auto* measured = std::get_if<MeasuredItems>(&none))
    static_cast<DocumentInfo&>(measured->first) = info;
  return none;
}

/// A part of the file on its way.
struct PartTask {
  Document<Feature> features;
  double points = 0;
  LoadReport load;
  AxesReport report;
  StreamItems made;
  Part numbers{false, false};
  std::shared_ptr<void> prepared;
  std::optional<Error> error;
  bool unwritable = false;  ///< whether the error is one of the output
};

/// Reads, computes and writes all parts of a file.
class Stream {
 public:
  Stream(PartReader reader, const Survey& survey, const StreamItems& none,
         const StreamOptions& options, PartWriter& writer)
      : reader_(std::move(reader)),
        survey_(survey),
        none_(none),
        options_(options),
        writer_(writer) {
    report.document = survey.common;
  }

  Status run() {
    if (Status begun = write_frame({true, false}); !begun) return begun;
    const auto stage = [this](bool in_order, void (Stream::*work)(PartTask&)) {
      return PipelineStage{in_order, [this, work](void* task) {
                             PartTask& part = *static_cast<PartTask*>(task);
                             if (part.error || failed_.load()) return;
                             try {
                               (this->*work)(part);
                             } catch (...) {
                               part.error = error_in_flight();
                             }
                           }};
    };
    const std::array stages{
        stage(false, &Stream::compute), stage(true, &Stream::number),
        stage(false, &Stream::prepare), stage(true, &Stream::add),
        PipelineStage{true, [this](void* task) { take_error(*static_cast<PartTask*>(task)); }}};
    run_pipeline(
        options_.threads, window_of(effective_threads(options_.threads)), [this] { return next(); },
        stages);
    if (input_error) return *input_error;
    if (output_error_) return *output_error_;
    if (report.load.left_out > 0)
      report.document.notes.push_back(invalid_left_out(report.load.left_out, report.load.features));
    if (Status ended = write_frame({false, true}); !ended) return ended;
    return writer_.finish();
  }

  StreamReport report;
  std::optional<Error> input_error;  ///< why run() failed, if not for the output

 private:
  std::shared_ptr<void> next() {
    if (ended_ || failed_.load()) return nullptr;
    auto part = reader_.next();
    if (part && !*part) return nullptr;
    auto task = std::make_shared<PartTask>();
    if (!part) {
      task->error = std::move(part).error();
      ended_ = true;
      return task;
    }
    task->features = std::move(**part);
    for (const Feature& feature : task->features.items)
      task->points += static_cast<double>(point_count(feature));
    task->features.crs_wkt = survey_.common.crs_wkt;
    task->features.geographic = survey_.common.geographic;
    task->features.unit = survey_.common.unit;
    task->features.notes.clear();  // the survey has them
    return task;
  }

  void compute(PartTask& part) {
    part.made = none_;
    if (part.features.items.empty()) return;
    const int threads = part.points >= long_work ? options_.threads : 1;
    LoadOptions load = options_.source.load;
    load.skip_invalid = options_.source.read.skip_invalid;
    load.part = true;
    load.threads = threads;
    auto shapes = load_shapes(std::move(part.features), load, &part.load);
    if (!shapes) {
      part.error = std::move(shapes).error();
      return;
    }
    if (shapes->items.empty()) {
      info_of(part.made).notes = std::move(shapes->notes);
      return;
    }
    auto made = options_.compute(std::move(*shapes), threads, part.report);
    if (made)
      part.made = std::move(*made);
    else
      part.error = std::move(made).error();
  }

  void number(PartTask& part) {
    part.numbers = next_;
    next_.feature +=
        std::visit([](auto& made) { return features_of(made).items.size(); }, part.made);
    if (const auto* axes = std::get_if<Document<AxisItem>>(&part.made))
      for (const AxisItem& item : axes->items) {
        next_.node += item.axis.nodes.size();
        next_.edge += item.axis.edges.size();
      }
    report.load += part.load;
    report.axes.statistics += part.report.statistics;
    report.axes.unresolved += part.report.unresolved;
    report.axes.by_disks += part.report.by_disks;
    report.axes.pixels = std::max(report.axes.pixels, part.report.pixels);
    std::ranges::move(part.report.left_out, std::back_inserter(report.axes.left_out));
    std::ranges::move(info_of(part.made).notes, std::back_inserter(report.document.notes));
    if (options_.visit) options_.visit(part.made);
  }

  void prepare(PartTask& part) {
    auto prepared = writer_.prepare(output_of(part.made, options_.write), part.numbers);
    if (!prepared) return fail_to_write(part, std::move(prepared).error());
    part.prepared = std::move(*prepared);
    part.made = none_;
  }

  void add(PartTask& part) {
    if (Status added = writer_.add(part.prepared.get()); !added)
      return fail_to_write(part, std::move(added).error());
    part.prepared.reset();
    done_ += part.points;
    if (options_.progress)
      options_.progress(std::min(1.0, done_ / survey_.points), survey_.features);
  }

  /// The first error in the order of the file is the one that counts.
  void take_error(PartTask& part) {
    if (!part.error || failed_.exchange(true)) return;
    (part.unwritable ? output_error_ : input_error) = std::move(part.error);
  }

  static void fail_to_write(PartTask& part, Error error) {
    part.error = std::move(error);
    part.unwritable = true;
  }

  /// What stands before the first part, or behind the last one.
  Status write_frame(const Part& part) {
    auto prepared = writer_.prepare(output_of(none_, options_.write), part);
    return prepared ? writer_.add(prepared->get()) : Status(std::move(prepared).error());
  }

  PartReader reader_;
  const Survey& survey_;
  const StreamItems& none_;
  const StreamOptions& options_;
  PartWriter& writer_;
  Part next_{false, false};
  double done_ = 0;
  bool ended_ = false;                ///< nothing more is read
  std::atomic<bool> failed_ = false;  ///< parts behind the first error do nothing
  std::optional<Error> output_error_;
};

/// Several layers stand one after another in a text, so none is complete before all features are.
bool holds_in_parts(const Format& format, const StreamItems& none) {
  const auto* measured = std::get_if<MeasuredItems>(&none);
  return format.write_parts != nullptr ||
         (format.in_parts && (measured == nullptr || measured->first.items.size() == 1));
}

}  // namespace

Result<std::optional<StreamReport>> stream(const std::string& path, const Destination& target,
                                           const std::string& format,
                                           const StreamOptions& options) {
  const bool silent = target.path.empty();
  const DocumentKind kind = std::visit([](const auto& none) { return none.kind; },
                                       output_of(options.none, options.write));
  const Result<const Format*> found =
      silent ? nullptr : find_format(format_name(target.path, format), kind);
  if (!found) return Error{found.error().code, found.error().text, in_file(target.path)};
  const Format* row = *found;
  // What has gone to a pipe cannot be taken back after an error.
  if (!(silent || (row != nullptr && holds_in_parts(*row, options.none))) ||
      (is_stream(target.path) && target.text == nullptr) ||
      !is_large_file(path, options.least_bytes) || needs_all_features(options.source))
    return std::optional<StreamReport>();
  const ReadOptions& read = options.source.read;
  TwiceRead file{path, read};
  auto surveyed = survey_file(file, options.most_points);
  if (!surveyed) return std::move(surveyed).error();
  if (!*surveyed) return std::optional<StreamReport>();
  std::optional<Survey>& survey = *surveyed;
  DocumentInfo info = survey->common;
  info.notes.clear();
  StreamItems given = options.none;
  if (info_of(given).corner_angle > 0) info.corner_angle = info_of(given).corner_angle;
  const StreamItems none = without_items(options.none, info);
  const PartOutput frame = output_of(none, options.write);
  survey->columns.finish(survey->common,
                         std::visit([](const auto& output) { return own_columns(output); }, frame));
  std::optional<StreamReport> report;
  std::optional<Error> input_error;
  const auto write_by = [&](PartWriter& writer) -> Status {
    auto again = file.again();
    if (!again) return std::move(again).error();
    Stream parts(*again, *survey, none, options, writer);
    Status done = parts.run();
    report = std::move(parts.report);
    input_error = std::move(parts.input_error);
    return done;
  };
  const auto write = [&](Target& to, const Format& chosen) -> Status {
    to.columns = std::make_shared<const AttributeColumns>(std::move(survey->columns));
    to.arcs = survey->arcs;
    auto writer = writer_of_parts(to, chosen, frame);
    return writer ? write_by(**writer) : Status(std::move(writer).error());
  };
  Status done =
      silent ? write_by(*writer_of_nothing())
             : write_target(target, format,
                            {kind, kind == DocumentKind::layers ? "geojson" : "json", "medial",
                             info.crs_wkt, info.unit, options.write.overwrite, options.write.layer},
                            write);
  if (input_error) return *input_error;
  if (!done) return std::move(done).error();
  return report;
}

}  // namespace medial::io

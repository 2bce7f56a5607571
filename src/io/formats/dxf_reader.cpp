#include <dl_creationadapter.h>
#include <dl_dxf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "io/formats/dxf.h"
#include "io/formats/dxf_drawing.h"
#include "io/formats/dxf_text.h"
#include "io/join.h"
#include "io/path_builder.h"

namespace medial::io {

namespace {

// What blocks may unfold to, however deeply they are nested: a drawing can ask for a billion copies
// in a kilobyte.
constexpr std::uint64_t most_copied = 10'000'000;  // control points
constexpr std::uint64_t most_inserts = 1'000'000;
constexpr int deepest_block = 64;  // blocks inside blocks

/// Thrown inside this file only, and caught in read_dxf().
struct Refused {
  Error error;
};

[[noreturn]] void refuse(ErrorCode code, std::string text) {
  throw Refused{{code, std::move(text), {}}};
}

/// A block put somewhere: columns times rows of copies.
struct Insert {
  std::string layer;
  std::string block;
  Affine map;  ///< of the copy in column and row 0
  int columns = 1;
  int rows = 1;
  Vec2 column_step;
  Vec2 row_step;
};

struct DxfCurve {
  std::string layer;
  Contour contour;
  bool closed = false;
};

struct Block {
  Vec2 base;
  std::vector<DxfCurve> curves;
  std::vector<Insert> inserts;
};

Vec2 direction_of_degrees(double degrees) {
  const double quarters = degrees / 90;
  if (quarters == std::floor(quarters)) {  // exact where it can be
    switch (static_cast<int>(std::fmod(quarters, 4) + 4) % 4) {
      case 0:
        return {1, 0};
      case 1:
        return {0, 1};
      case 2:
        return {-1, 0};
      default:
        return {0, -1};
    }
  }
  const double angle = degrees * (std::numbers::pi / 180);
  return {std::cos(angle), std::sin(angle)};
}

/// Receives what dxflib finds. Entities are kept by block; the drawing itself is the block "".
class Collector : public DL_CreationAdapter {
 public:
  std::map<std::string, Block> blocks;
  std::set<std::string> layers;
  std::set<std::string> hidden;
  std::map<std::string, std::uint64_t> left_out;

  void addLayer(const DL_LayerData& data) override {
    layers.insert(data.name);
    const bool frozen = (data.flags & 1) != 0;
    if (frozen || data.off || getAttributes().getColor() < 0) hidden.insert(data.name);
  }
  void addBlock(const DL_BlockData& data) override {
    finish();
    block_ = data.name;
    blocks[block_] = {{data.bpx, data.bpy}, {}, {}};
  }
  void endBlock() override {
    finish();
    block_.clear();
  }

  void addPoint(const DL_PointData& data) override {
    if (!begin("POINT")) return;
    Contour contour;
    contour.start_at({data.x, data.y});
    add(std::move(contour), false);
  }
  void addLine(const DL_LineData& data) override {
    if (!begin("LINE")) return;
    Contour contour;
    contour.start_at({data.x1, data.y1});
    contour.line_to({data.x2, data.y2});
    add(std::move(contour), false);
  }
  void addCircle(const DL_CircleData& data) override {
    if (!begin("CIRCLE") || !(data.radius > 0)) return;
    add(closed_ellipse({data.cx, data.cy}, {data.radius, 0}, {0, data.radius}), true, true);
  }
  void addArc(const DL_ArcData& data) override {
    if (!begin("ARC") || !(data.radius > 0)) return;
    double turn = std::fmod(data.angle2 - data.angle1, 360);
    if (turn <= 0) turn += 360;
    const Vec2 center{data.cx, data.cy};
    const Vec2 u = data.radius * direction_of_degrees(data.angle1);
    const Vec2 end = center + data.radius * direction_of_degrees(data.angle2);
    Contour contour;
    contour.start_at(center + u);
    add_arc(contour, {center, u, left_of(u), 0, turn * (std::numbers::pi / 180)}, end);
    add(std::move(contour), false, true);
  }
  void addEllipse(const DL_EllipseData& data) override {
    // Ellipses stand in world coordinates; their extrusion says where the minor axis points.
    const double side = upside_down() ? -1 : 1;
    if (!begin("ELLIPSE")) return;
    const Vec2 center{data.cx, data.cy};
    const Vec2 u{data.mx, data.my};
    const Vec2 v = side * data.ratio * left_of(u);
    const double turn = data.angle2 - data.angle1;
    if (!(squared_norm(u) > 0) || !(squared_norm(v) > 0)) return;
    constexpr double whole = 2 * std::numbers::pi;
    constexpr double digits = 1e-6;  // angles are written with few digits
    if (std::fabs(std::remainder(turn, whole)) < digits) {
      return add(closed_ellipse(center, u, v), true);
    }
    const double end = data.angle1 + std::fmod(std::fmod(turn, whole) + whole, whole);
    const EllipticalArc arc{center, u, v, data.angle1, end};
    Contour contour;
    contour.start_at(center + std::cos(arc.begin) * u + std::sin(arc.begin) * v);
    add_arc(contour, arc, std::nullopt);
    add(std::move(contour), false);
  }

  void addPolyline(const DL_PolylineData& data) override {
    if (!begin("POLYLINE")) return;
    constexpr int mesh_flags = 16 | 64;
    if ((data.flags & mesh_flags) != 0) {
      ++left_out["polygon mesh"];
      return;
    }
    kind_ = Kind::polyline;
    closed_ = (data.flags & 1) != 0;
    remember_attributes();
  }
  void addVertex(const DL_VertexData& data) override {
    if (kind_ != Kind::polyline) return;
    points_.push_back({data.x, data.y});
    numbers_.push_back(data.bulge);
  }
  void addSpline(const DL_SplineData& data) override {
    if (!begin("SPLINE")) return;
    kind_ = Kind::spline;
    degree_ = data.degree;
    closed_ = (data.flags & 1) != 0;
    remember_attributes();
  }
  void addControlPoint(const DL_ControlPointData& data) override {
    if (kind_ != Kind::spline) return;
    points_.push_back({data.x, data.y});
    numbers_.push_back(data.w);
  }
  void addKnot(const DL_KnotData& data) override { knots_.push_back(data.k); }

  void addInsert(const DL_InsertData& data) override {
    if (!begin("INSERT")) return;
    if (getAttributes().isInPaperSpace()) return;
    const Vec2 x = direction_of_degrees(data.angle);
    Insert insert;
    insert.layer = getAttributes().getLayer();
    insert.block = data.name;
    insert.map = {data.sx * x, data.sy * left_of(x), {data.ipx, data.ipy}};
    insert.columns = std::max(data.cols, 1);
    insert.rows = std::max(data.rows, 1);
    insert.column_step = data.colSp * x;
    insert.row_step = data.rowSp * left_of(x);
    if (upside_down()) {
      const Affine mirror{{-1, 0}, {0, 1}, {}};
      insert.map = mirror * insert.map;
      insert.column_step = mirror.vector(insert.column_step);
      insert.row_step = mirror.vector(insert.row_step);
    }
    blocks[block_].inserts.push_back(std::move(insert));
  }

  void endEntity() override { finish(); }
  void endSequence() override { finish(); }

  /// Ends the polyline or spline under way.
  void finish() {
    const Kind kind = kind_;
    kind_ = Kind::none;
    if (kind == Kind::polyline) finish_polyline();
    if (kind == Kind::spline) finish_spline();
    points_.clear();
    numbers_.clear();
    knots_.clear();
  }

 private:
  enum class Kind : std::uint8_t { none, polyline, spline };

  /// Entities that lie in planes of their own: only those parallel to the drawing's are read.
  bool begin(const char* name) {
    finish();
    const double* direction = getExtrusion()->getDirection();
    constexpr double tilt = 1e-9;
    if (std::fabs(direction[0]) > tilt || std::fabs(direction[1]) > tilt) {
      ++left_out[std::string("tilted ") + name];
      return false;
    }
    return true;
  }
  bool upside_down() { return getExtrusion()->getDirection()[2] < 0; }

  void remember_attributes() {
    layer_ = getAttributes().getLayer();
    paper_ = getAttributes().isInPaperSpace();
    mirrored_ = upside_down();
  }
  /// `in_plane`: given in the coordinates of the entity's own plane, not of the drawing.
  void add(Contour contour, bool closed, bool in_plane = false) {
    remember_attributes();
    keep(std::move(contour), closed, in_plane);
  }
  void keep(Contour contour, bool closed, bool in_plane) {
    if (paper_) return;
    if (in_plane && mirrored_) contour = transformed({{-1, 0}, {0, 1}, {}}, contour);
    blocks[block_].curves.push_back({layer_, std::move(contour), closed});
  }

  void finish_polyline() {
    if (points_.size() < 2) return;
    Contour contour;
    contour.start_at(points_[0]);
    for (std::size_t i = 1; i < points_.size(); ++i) {
      add_arc(contour, points_[i], numbers_[i - 1]);
    }
    if (closed_ && !(points_.back() == points_.front())) {
      add_arc(contour, points_.front(), numbers_.back());
    }
    keep(std::move(contour), closed_, true);
  }

  void finish_spline() {
    if (points_.empty()) {
      ++left_out["SPLINE of fit points only"];
      return;
    }
    const bool rational = std::ranges::any_of(numbers_, [](double w) { return w != 1; });
    Contour contour;
    Status status =
        contour.spline_to(degree_, knots_, points_,
                          rational ? std::span<const double>(numbers_) : std::span<const double>());
    if (!status) throw Refused{std::move(status).error()};
    const bool comes_back = contour.points.back() == contour.points.front();
    keep(std::move(contour), closed_ || comes_back, false);
  }

  std::string block_;
  Kind kind_ = Kind::none;
  bool closed_ = false;
  std::uint32_t degree_ = 0;
  std::string layer_;
  bool paper_ = false;
  bool mirrored_ = false;
  std::vector<Vec2> points_;
  std::vector<double> numbers_;  ///< bulges or weights
  std::vector<double> knots_;
};

/// The curves of a drawing by layer: the drawing's own, then those of what is inserted.
class Unfolded {
 public:
  explicit Unfolded(const Collector& found) : found_(found) {}

  struct Layer {
    std::string name;
    std::vector<Contour> closed;
    std::vector<Contour> open;
  };
  std::vector<Layer> layers;

  /// Adds a block's curves; layer "0" inside of a block is the layer of its insertion.
  void add(const std::string& block, const Affine& map, const std::string& layer, int depth) {
    const auto found = found_.blocks.find(block);
    if (found == found_.blocks.end()) return;
    if (depth > deepest_block) {
      refuse(ErrorCode::unsupported,
             fmt::format("blocks are nested more than {} deep", deepest_block));
    }
    const Affine placed = map * Affine{{1, 0}, {0, 1}, -found->second.base};
    const auto own = [&layer, depth](const std::string& name) {
      return depth > 0 && name == "0" ? layer : name;
    };
    for (const DxfCurve& curve : found->second.curves) {
      if (depth > 0) {
        copied_ += curve.contour.points.size();
        if (copied_ > most_copied) {
          refuse(ErrorCode::too_large,
                 fmt::format("blocks unfold to more than {} points", most_copied));
        }
      }
      Layer& target = layer_of(own(curve.layer));
      (curve.closed ? target.closed : target.open)
          .push_back(depth > 0 ? transformed(placed, curve.contour) : curve.contour);
    }
    for (const Insert& insert : found->second.inserts) {
      for (int row = 0; row < insert.rows; ++row) {
        for (int column = 0; column < insert.columns; ++column) {
          if (++inserts_ > most_inserts) {
            refuse(ErrorCode::too_large,
                   fmt::format("blocks are inserted more than {} times", most_inserts));
          }
          Affine copy = insert.map;
          copy.origin = copy.origin + static_cast<double>(column) * insert.column_step +
                        static_cast<double>(row) * insert.row_step;
          add(insert.block, placed * copy, own(insert.layer), depth + 1);
        }
      }
    }
  }

 private:
  Layer& layer_of(const std::string& name) {
    const auto [found, added] = index_.try_emplace(name, layers.size());
    if (added) layers.push_back({name, {}, {}});
    return layers[found->second];
  }

  const Collector& found_;
  std::map<std::string, std::size_t> index_;
  std::uint64_t copied_ = 0;
  std::uint64_t inserts_ = 0;
};

/// The part of a drawing that becomes features, and notes on the rest.
class Features {
 public:
  Features(const Collector& found, const ReadOptions& options) : found_(found), options_(options) {}

  Result<Document<Feature>> of(Unfolded drawing, std::map<std::string, std::uint64_t> others) {
    const std::string& wanted = options_.layer;
    bool seen = wanted.empty() || found_.layers.contains(wanted);
    for (Unfolded::Layer& layer : drawing.layers) {
      if (!wanted.empty() && layer.name != wanted) continue;
      seen = true;
      if (wanted.empty() && found_.hidden.contains(layer.name))
        ++hidden_;
      else
        add(layer);
    }
    if (!seen) {
      std::string names;
      for (const Unfolded::Layer& layer : drawing.layers)
        names += (names.empty() ? "" : ", ") + layer.name;
      return Error{ErrorCode::invalid_option,
                   fmt::format("there is no layer '{}', but: {}", wanted, names),
                   {}};
    }
    for (const auto& [name, count] : found_.left_out) others.try_emplace(name, count);
    if (dataset_.items.empty()) take_cells();
    add_notes(others);
    if (dataset_.items.empty()) {
      std::string text = "there is no closed curve";
      for (const std::string& note : dataset_.notes) text += "; " + note;
      if (open_ > 0)
        text +=
            "; --close=GAP joins ends that are further apart, --close ends each curve where it "
            "began";
      return Error{ErrorCode::empty, text, {}};
    }
    return std::move(dataset_);
  }

 private:
  void add(Unfolded::Layer& layer) {
    Feature feature;
    feature.contours = std::move(layer.closed);
    if (options_.loose) {
      for (Contour& contour : layer.open) {
        contour.open = true;
        feature.contours.push_back(std::move(contour));
      }
    } else {
      join(layer, feature);
    }
    if (!feature.contours.empty()) add(std::move(feature), layer.name);
  }

  void add(Feature feature, const std::string& layer) {
    feature.filled = true;
    feature.id = static_cast<std::int64_t>(dataset_.items.size());
    feature.attributes.emplace_back("layer", layer);
    dataset_.items.push_back(std::move(feature));
  }

  /// What the curves of a net enclose, where no curve is closed.
  void take_cells() {
    if (cells_.empty()) return;
    dataset_.notes.push_back(
        fmt::format("no curve is closed: {} curves enclose {}, a feature each", in_cells_,
                    cells_.size() == 1 ? "one cell" : fmt::format("{} cells", cells_.size())));
    for (auto& [layer, cell] : cells_) {
      Feature feature;
      feature.contours.push_back(std::move(cell));
      add(std::move(feature), layer);
    }
    open_ -= in_cells_;
    smallest_gap_ = std::numeric_limits<double>::infinity();
  }

  void join(Unfolded::Layer& layer, Feature& feature) {
    std::erase_if(layer.open, [](const Contour& contour) { return contour.pieces.empty(); });
    JoinedCurves joined = join_curves(std::move(layer.open), options_.close);
    open_ += joined.open;
    if (joined.open > 0) smallest_gap_ = std::min(smallest_gap_, joined.smallest_gap);
    tolerance_ = std::max(tolerance_, joined.tolerance);
    in_cells_ += joined.in_cells;
    for (Contour& cell : joined.cells) cells_.emplace_back(layer.name, std::move(cell));
    std::ranges::move(joined.loops, std::back_inserter(feature.contours));
    std::erase_if(feature.contours, is_degenerate);
  }

  void add_notes(const std::map<std::string, std::uint64_t>& others) {
    if (open_ > 0) {
      std::string note =
          fmt::format("{} where ends within {:.3g} are joined, left out",
                      open_ == 1 ? "1 curve stays open" : fmt::format("{} curves stay open", open_),
                      tolerance_);
      if (std::isfinite(smallest_gap_))
        note += fmt::format("; the smallest gap is {:.3g}", smallest_gap_);
      dataset_.notes.push_back(std::move(note));
    }
    if (!others.empty()) {
      std::string text;
      for (const auto& [name, count] : others)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
      dataset_.notes.push_back("left out because they are not outlines: " + text);
    }
    if (hidden_ > 0)
      dataset_.notes.push_back(fmt::format("{} hidden layers were left out", hidden_));
  }

  const Collector& found_;
  const ReadOptions& options_;
  Document<Feature> dataset_;
  std::vector<std::pair<std::string, Contour>> cells_;  ///< with their layers
  std::uint64_t in_cells_ = 0;                          ///< curves around them
  std::uint64_t open_ = 0;
  std::uint64_t hidden_ = 0;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  double tolerance_ = 0;
};

}  // namespace

Result<Document<Feature>> read_dxf(const Input& input, const ReadOptions& options) {
  Result<DxfText> text = read_dxf_text(*input.source);
  if (!text) return text.error();
  try {
    Collector found;
    std::istringstream stream(std::move(text->text));
    DL_Dxf().in(stream, &found);
    found.finish();
    Unfolded drawing(found);
    drawing.add("", {}, "", 0);
    auto features = Features(found, options).of(std::move(drawing), std::move(text->others));
    if (features) features->unit = unit_of_dxf(text->units);
    return features;
  } catch (const Refused& refused) {
    return refused.error;
  }
}

}  // namespace medial::io

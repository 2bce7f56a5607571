#include "io/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "io/join.h"

namespace medial::io {

namespace {

// What blocks may unfold to, however deeply they are nested: a drawing can ask for a billion copies
// in a kilobyte.
constexpr std::uint64_t most_copied = 10'000'000;  // control points
constexpr std::uint64_t most_inserts = 1'000'000;
constexpr int deepest_block = 64;  // blocks inside blocks

constexpr std::array<std::pair<int, Unit>, 11> units_of_dxf{{{1, Unit::inch},
                                                             {2, Unit::foot},
                                                             {4, Unit::millimetre},
                                                             {5, Unit::centimetre},
                                                             {6, Unit::metre},
                                                             {7, Unit::kilometre},
                                                             {9, Unit::mil},
                                                             {10, Unit::yard},
                                                             {13, Unit::micrometre},
                                                             {21, Unit::us_foot},
                                                             {0, Unit::unknown}}};

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

constexpr Affine seen_from_below{{-1, 0}, {0, 1}, {}};

/// The curves of a drawing by layer: the drawing's own, then those of what is inserted.
class Unfolded {
 public:
  explicit Unfolded(const Drawing& drawing) : drawing_(drawing) {}

  struct Layer {
    std::string name;
    std::vector<Contour> closed;
    std::vector<Contour> open;
  };
  std::vector<Layer> layers;

  /// Adds a block's curves; layer "0" inside a block is the layer of its insertion.
  Status add(const std::string& block, const Affine& map, const std::string& layer, int depth) {
    const auto found = drawing_.blocks.find(block);
    if (found == drawing_.blocks.end()) return success();
    if (depth > deepest_block)
      return refused(ErrorCode::unsupported, "nested", deepest_block, "deep");
    const Affine placed = map * Affine{{1, 0}, {0, 1}, -found->second.base};
    const auto own = [&layer, depth](const std::string& name) {
      return depth > 0 && name == "0" ? layer : name;
    };
    for (const Drawing::Curve& curve : found->second.curves) {
      if (depth > 0) copied_ += curve.contour.points.size();
      if (copied_ > most_copied)
        return Error{ErrorCode::too_large,
                     fmt::format("blocks expand to more than {} points", most_copied),
                     {}};
      Layer& target = layer_of(own(curve.layer));
      (curve.closed ? target.closed : target.open)
          .push_back(depth > 0 ? transformed(placed, curve.contour) : curve.contour);
    }
    for (const Drawing::Insert& insert : found->second.inserts)
      if (Status status = add(insert, placed, own(insert.layer), depth + 1); !status) return status;
    return success();
  }

 private:
  static Error refused(ErrorCode code, const char* what, std::uint64_t most, const char* than) {
    return {code, fmt::format("blocks are {} more than {} {}", what, most, than), {}};
  }
  Status add(const Drawing::Insert& insert, const Affine& placed, const std::string& layer,
             int depth) {
    for (int row = 0; row < insert.rows; ++row) {
      for (int column = 0; column < insert.columns; ++column) {
        if (++inserts_ > most_inserts)
          return refused(ErrorCode::too_large, "inserted", most_inserts, "times");
        Affine copy = insert.map;
        copy.origin = copy.origin + static_cast<double>(column) * insert.column_step +
                      static_cast<double>(row) * insert.row_step;
        if (Status status = add(insert.block, placed * copy, layer, depth); !status) return status;
      }
    }
    return success();
  }
  Layer& layer_of(const std::string& name) {
    const auto [found, added] = index_.try_emplace(name, layers.size());
    if (added) layers.push_back({name, {}, {}});
    return layers[found->second];
  }

  const Drawing& drawing_;
  std::map<std::string, std::size_t> index_;
  std::uint64_t copied_ = 0;
  std::uint64_t inserts_ = 0;
};

/// The part of a drawing that becomes features, and notes on the rest.
class Features {
 public:
  Features(const Drawing& drawing, const ReadOptions& options)
      : drawing_(drawing), options_(options), others_(drawing.left_out) {}

  Result<Document<Feature>> of(Unfolded unfolded) {
    const std::string& wanted = options_.layer;
    bool seen = wanted.empty() || drawing_.layers.contains(wanted);
    for (Unfolded::Layer& layer : unfolded.layers) {
      if (!wanted.empty() && layer.name != wanted) continue;
      seen = true;
      if (wanted.empty() && drawing_.hidden.contains(layer.name))
        ++hidden_;
      else
        add(layer);
    }
    if (!seen) {
      std::string names;
      for (const Unfolded::Layer& layer : unfolded.layers)
        names += (names.empty() ? "" : ", ") + layer.name;
      return Error{ErrorCode::invalid_option,
                   fmt::format("there is no layer '{}'; the layers are: {}", wanted, names),
                   {}};
    }
    if (dataset_.items.empty()) take_cells();
    add_notes();
    if (dataset_.items.empty()) {
      std::string text = "there is no closed curve";
      for (const std::string& note : dataset_.notes) text += "; " + note;
      if (open_ > 0)
        text +=
            "; --close=GAP joins ends that are further apart, --close ends each curve where it "
            "began";
      return Error{ErrorCode::empty, text, {}};
    }
    dataset_.unit = unit_of_dxf(drawing_.units);
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
    dataset_.text_attributes = {"layer"};
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
    const auto is_point = [](const Contour& contour) { return contour.pieces.empty(); };
    if (const auto points = std::erase_if(layer.open, is_point)) others_["POINT"] += points;
    JoinedCurves joined = join_curves(std::move(layer.open), options_.close);
    open_ += joined.open;
    if (joined.open > 0) smallest_gap_ = std::min(smallest_gap_, joined.smallest_gap);
    tolerance_ = std::max(tolerance_, joined.tolerance);
    in_cells_ += joined.in_cells;
    for (Contour& cell : joined.cells) cells_.emplace_back(layer.name, std::move(cell));
    std::ranges::move(joined.loops, std::back_inserter(feature.contours));
    std::erase_if(feature.contours, is_degenerate);
  }

  void add_notes() {
    if (open_ > 0) {
      std::string note =
          fmt::format("{} left out, although ends within {:.3g} are joined",
                      open_ == 1 ? "1 curve stays open and was"
                                 : fmt::format("{} curves stay open and were", open_),
                      tolerance_);
      if (std::isfinite(smallest_gap_))
        note += fmt::format("; the smallest gap is {:.3g}", smallest_gap_);
      dataset_.notes.push_back(std::move(note));
    }
    if (!others_.empty()) {
      std::string text;
      for (const auto& [name, count] : others_)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
      dataset_.notes.push_back("left out because they are not outlines: " + text);
    }
    if (hidden_ > 0)
      dataset_.notes.push_back(fmt::format("{} hidden layers were left out", hidden_));
  }

  const Drawing& drawing_;
  const ReadOptions& options_;
  std::map<std::string, std::uint64_t> others_;  ///< entities left out, by name
  Document<Feature> dataset_;
  std::vector<std::pair<std::string, Contour>> cells_;  ///< with their layers
  std::uint64_t in_cells_ = 0;                          ///< curves around them
  std::uint64_t open_ = 0;
  std::uint64_t hidden_ = 0;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  double tolerance_ = 0;
};

}  // namespace

int dxf_units(Unit unit) {
  for (const auto& [number, one] : units_of_dxf)
    if (one == unit) return number;
  return 0;
}
Unit unit_of_dxf(int units) {
  for (const auto& [number, one] : units_of_dxf)
    if (number == units) return one;
  return Unit::unknown;
}

void Drawing::begin_block(const std::string& name, Vec2 base) {
  block_ = &blocks[name];
  *block_ = {base, {}, {}};
}

bool Drawing::begin_entity(const std::string& name, std::string layer,
                           const std::array<double, 3>& normal) {
  constexpr double tilt = 1e-9;
  if (std::fabs(normal[0]) > tilt || std::fabs(normal[1]) > tilt) {
    ++left_out["tilted " + name];
    return false;
  }
  layer_ = std::move(layer);
  mirrored_ = normal[2] < 0;
  return true;
}

void Drawing::keep_in_plane(Contour contour, bool closed) {
  keep(mirrored_ ? transformed(seen_from_below, contour) : std::move(contour), closed);
}

void Drawing::add_point(Vec2 point) {
  Contour contour;
  contour.start_at(point);
  keep(std::move(contour), false);
}

void Drawing::add_line(Vec2 begin, Vec2 end) {
  Contour contour;
  contour.start_at(begin);
  contour.line_to(end);
  keep(std::move(contour), false);
}

void Drawing::add_circle(Vec2 center, double radius) {
  if (!(radius > 0)) return;
  keep_in_plane(closed_ellipse(center, {radius, 0}, {0, radius}), true);
}

void Drawing::add_arc(Vec2 center, double radius, double begin, double end) {
  if (!(radius > 0)) return;
  double turn = std::fmod(end - begin, 360);
  if (turn <= 0) turn += 360;
  const Vec2 u = radius * direction_of_degrees(begin);
  Contour contour;
  contour.start_at(center + u);
  io::add_arc(contour, {center, u, left_of(u), 0, turn * (std::numbers::pi / 180)},
              center + radius * direction_of_degrees(end));
  keep_in_plane(std::move(contour), false);
}

// Ellipses stand in world coordinates; their normal says where the minor axis points.
void Drawing::add_ellipse(Vec2 center, Vec2 major, double ratio, double begin, double end) {
  const Vec2 minor = (mirrored_ ? -ratio : ratio) * left_of(major);
  const double turn = end - begin;
  if (!(squared_norm(major) > 0) || !(squared_norm(minor) > 0)) return;
  constexpr double whole = 2 * std::numbers::pi;
  constexpr double digits = 1e-6;  // angles are written with few digits
  if (std::fabs(std::remainder(turn, whole)) < digits)
    return keep(closed_ellipse(center, major, minor), true);
  const double last = begin + std::fmod(std::fmod(turn, whole) + whole, whole);
  const EllipticalArc arc{center, major, minor, begin, last};
  Contour contour;
  contour.start_at(center + std::cos(begin) * major + std::sin(begin) * minor);
  io::add_arc(contour, arc, std::nullopt);
  keep(std::move(contour), false);
}

void Drawing::add_polyline(const std::vector<Vec2>& points, const std::vector<double>& bulges,
                           bool closed) {
  if (points.size() < 2) return;
  Contour contour;
  contour.start_at(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) io::add_arc(contour, points[i], bulges[i - 1]);
  if (closed && !(points.back() == points.front()))
    io::add_arc(contour, points.front(), bulges.back());
  keep_in_plane(std::move(contour), closed);
}

Status Drawing::add_spline(std::uint32_t degree, const std::vector<double>& knots,
                           const std::vector<Vec2>& points, const std::vector<double>& weights,
                           bool closed) {
  if (points.empty()) {
    ++left_out["SPLINE of fit points only"];
    return success();
  }
  const bool rational = std::ranges::any_of(weights, [](double w) { return w != 1; });
  Contour contour;
  Status status =
      contour.spline_to(degree, knots, points,
                        rational ? std::span<const double>(weights) : std::span<const double>());
  if (!status) return status;
  const bool comes_back = contour.points.back() == contour.points.front();
  keep(std::move(contour), closed || comes_back);
  return success();
}

void Drawing::add_copies(const BlockCopies& copies) {
  const Vec2 x = direction_of_degrees(copies.angle);
  const Affine map = mirrored_ ? seen_from_below : Affine{};
  block_->inserts.push_back(
      {layer_, copies.block,
       map * Affine{copies.scale_x * x, copies.scale_y * left_of(x), copies.place},
       std::max(copies.columns, 1), std::max(copies.rows, 1), map.vector(copies.column_step * x),
       map.vector(copies.row_step * left_of(x))});
}

Result<Document<Feature>> features_of(const Drawing& drawing, const ReadOptions& options) {
  Unfolded unfolded(drawing);
  if (Status status = unfolded.add("", {}, "", 0); !status) return status.error();
  return Features(drawing, options).of(std::move(unfolded));
}

}  // namespace medial::io

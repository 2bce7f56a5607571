#include "medial/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/tolerance.h"
#include "ops/code_bytes.h"
#include "ops/disk_lines.h"
#include "ops/hull_outline.h"

namespace medial {
namespace {

using ops::ByteReader;
using ops::Bytes;
using ops::DiskGraph;
using ops::DiskLine;

/// The quantum and the error are floats; or doubles, where they are out of the range of floats.
constexpr std::uint64_t float_version = 1, double_version = 2;
/// Multiples of the quantum stay exact, and so do their sums.
constexpr double largest = 0x1p52;

Error malformed(const char* text) { return {ErrorCode::malformed, text, {}}; }

/// A disk in multiples of the quantum.
struct Grid {
  std::int64_t x = 0, y = 0, r = 0;
};

/// How a code writes its quantum and its error.
class Head {
 public:
  Head(double quantum, double error) : floats_(is_float(quantum) && is_float(error)) {}

  std::uint64_t version() const { return floats_ ? float_version : double_version; }
  /// The largest number that can be written and is not above `value`.
  double below(double value) const {
    if (!floats_) return value;
    const auto out = static_cast<float>(value);
    return out > value ? std::nextafter(out, -std::numeric_limits<float>::infinity()) : out;
  }
  void put(Bytes& out, double value) const {
    const std::uint64_t bits = floats_ ? bit_cast<std::uint32_t>(static_cast<float>(value))
                                       : bit_cast<std::uint64_t>(value);
    for (unsigned shift = 0; shift < (floats_ ? 32U : 64U); shift += 8)
      out.push_back(static_cast<std::uint8_t>(bits >> shift));
  }

 private:
  static bool is_float(double value) {
    return value >= std::numeric_limits<float>::min() && value <= 0x1p127;
  }
  bool floats_;
};

class AxisEncoder {
 public:
  AxisEncoder(ShapeCode& code, double quantum) : code_(code), quantum_(quantum) {}

  /// False where a number is too large for the quantum.
  bool add(const DiskGraph& graph) {
    std::vector<std::vector<std::uint32_t>> around(graph.junctions.size());
    for (std::uint32_t i = 0; i < graph.lines.size(); ++i) {
      around[graph.lines[i].from].push_back(i);
      if (graph.lines[i].to != graph.lines[i].from) around[graph.lines[i].to].push_back(i);
    }
    std::vector<bool> drawn(graph.lines.size(), false);
    std::vector<std::uint32_t> number(graph.junctions.size(), no_site);
    std::vector<Grid> place(graph.junctions.size());
    std::uint32_t numbered = 0, roots = 0;
    Bytes structure;
    std::vector<std::uint32_t> stack;
    for (std::uint32_t root = 0; root < graph.junctions.size(); ++root) {
      if (number[root] != no_site) continue;
      ++roots;
      place[root] = put_disk(graph.junctions[root], last_root_);
      last_root_ = place[root];
      number[root] = numbered++;
      stack.push_back(root);
      while (!stack.empty()) {
        const std::uint32_t at = stack.back();
        stack.pop_back();
        const auto open = std::count_if(around[at].begin(), around[at].end(),
                                        [&](std::uint32_t i) { return !drawn[i]; });
        ops::put_number(structure, static_cast<std::uint64_t>(open));
        for (const std::uint32_t i : around[at]) {
          if (drawn[i]) continue;
          drawn[i] = true;
          const DiskLine& line = graph.lines[i];
          const bool forward = line.from == at;
          const std::uint32_t end = forward ? line.to : line.from;
          const bool closes = number[end] != no_site;
          const std::size_t inner = line.disks.size() - 2;
          ops::put_number(structure, 2 * static_cast<std::uint64_t>(inner) + (closes ? 1 : 0));
          Grid last = place[at];
          for (std::size_t k = 1; k <= inner; ++k)
            last = put_disk(line.disks[forward ? k : line.disks.size() - 1 - k], last);
          if (closes) {
            ops::put_number(structure, number[end]);
            continue;
          }
          place[end] = put_disk(graph.junctions[end], last);
          number[end] = numbered++;
          stack.push_back(end);
        }
      }
    }
    ops::put_number(code_[0], roots);
    code_[0].insert(code_[0].end(), structure.begin(), structure.end());
    return fits_;
  }

 private:
  Grid put_disk(const Disk& disk, const Grid& last) {
    const auto round = [this](double value) {
      const double multiple = std::round(value / quantum_);
      if (!(std::abs(multiple) <= largest)) {
        fits_ = false;
        return std::int64_t{0};
      }
      return static_cast<std::int64_t>(multiple);
    };
    const Grid grid{round(disk.center.x), round(disk.center.y), round(disk.radius)};
    ops::put_signed(code_[1], grid.x - last.x);
    ops::put_signed(code_[2], grid.y - last.y);
    ops::put_signed(code_[3], grid.r - last.r);
    return grid;
  }

  ShapeCode& code_;
  double quantum_;
  Grid last_root_;
  bool fits_ = true;
};

class AxisDecoder {
 public:
  explicit AxisDecoder(const ShapeCode& code)
      : structure_(code[0]), x_(code[1]), y_(code[2]), r_(code[3]) {}

  Result<std::vector<MedialAxis>> run() {
    const auto version = structure_.number();
    if (!version) return malformed("the code is empty");
    if (*version != float_version && *version != double_version)
      return Error{ErrorCode::unsupported, "the code is of another version", {}};
    const auto quantum = read_real(*version), error = read_real(*version);
    const auto count = structure_.number();
    if (!quantum || !error || !count) return malformed("the code ends early");
    if (!(*quantum > 0) || !std::isfinite(*quantum) || !(*error > 0) || !std::isfinite(*error))
      return malformed("the code's steps are not positive numbers");
    quantum_ = *quantum;
    // An item takes a byte at least.
    if (*count > structure_.left()) return malformed("the code has fewer shapes than it says");
    std::vector<MedialAxis> axes;
    for (std::uint64_t i = 0; i < *count; ++i) {
      MedialAxis& axis = axes.emplace_back();
      axis.method = "pack";
      axis.resolution = axis.tolerance = *error;
      if (!read_axis(axis)) return malformed("the code makes no axis");
    }
    if (structure_.left() + x_.left() + y_.left() + r_.left() > 0)
      return malformed("the code does not end with its last shape");
    return axes;
  }

 private:
  std::optional<double> read_real(std::uint64_t version) {
    const bool is_float = version == float_version;
    std::uint64_t bits = 0;
    for (unsigned shift = 0; shift < (is_float ? 32U : 64U); shift += 8) {
      const auto byte = structure_.byte();
      if (!byte) return std::nullopt;
      bits |= std::uint64_t{*byte} << shift;
    }
    return is_float ? bit_cast<float>(static_cast<std::uint32_t>(bits)) : bit_cast<double>(bits);
  }

  /// Moves on from `last`. False where the code ends, or numbers leave their range.
  bool read_disk(Grid& last) {
    const auto move = [](ByteReader& reader, std::int64_t& value) {
      const auto step = reader.signed_number();
      constexpr auto most = static_cast<std::int64_t>(largest);
      if (!step || *step > 2 * most || *step < -2 * most) return false;
      value += *step;
      return value <= most && value >= -most;
    };
    return move(x_, last.x) && move(y_, last.y) && move(r_, last.r) && last.r >= 0;
  }

  /// Reads the next disk from `last` on as a node.
  std::optional<std::uint32_t> read_node(MedialAxis& axis, Grid& last) {
    if (!read_disk(last)) return std::nullopt;
    const Disk disk{
        {static_cast<double>(last.x) * quantum_, static_cast<double>(last.y) * quantum_},
        static_cast<double>(last.r) * quantum_};
    if (!std::isfinite(disk.center.x) || !std::isfinite(disk.center.y) ||
        !std::isfinite(disk.radius) || axis.nodes.size() >= no_site)
      return std::nullopt;
    axis.nodes.push_back({disk, component_, NodeKind::site_change});
    return static_cast<std::uint32_t>(axis.nodes.size() - 1);
  }

  bool read_axis(MedialAxis& axis) {
    const auto roots = structure_.number();
    if (!roots) return false;
    std::vector<std::uint32_t> junctions, stack;
    std::vector<Grid> place;
    for (component_ = 0; component_ < *roots; ++component_) {
      const auto root = read_node(axis, last_root_);
      if (!root) return false;
      stack.push_back(static_cast<std::uint32_t>(junctions.size()));
      junctions.push_back(*root);
      place.push_back(last_root_);
      while (!stack.empty()) {
        const std::uint32_t at = stack.back();
        stack.pop_back();
        const auto lines = structure_.number();
        if (!lines) return false;
        for (std::uint64_t i = 0; i < *lines; ++i)
          if (!read_line(axis, at, junctions, place, stack)) return false;
      }
    }
    set_node_kinds(axis);
    return true;
  }

  bool read_line(MedialAxis& axis, std::uint32_t at, std::vector<std::uint32_t>& junctions,
                 std::vector<Grid>& place, std::vector<std::uint32_t>& stack) {
    const auto kind = structure_.number();
    if (!kind) return false;
    const bool closes = (*kind & 1U) != 0;
    Grid last = place[at];
    std::uint32_t before = junctions[at];
    for (std::uint64_t k = 0; k < *kind / 2; ++k) {
      const auto node = read_node(axis, last);
      if (!node) return false;
      axis.edges.push_back(straight_edge(axis, before, *node));
      before = *node;
    }
    if (closes) {
      const auto end = structure_.number();
      if (!end || *end >= junctions.size()) return false;
      axis.edges.push_back(straight_edge(axis, before, junctions[*end]));
      return true;
    }
    const auto node = read_node(axis, last);
    if (!node) return false;
    axis.edges.push_back(straight_edge(axis, before, *node));
    stack.push_back(static_cast<std::uint32_t>(junctions.size()));
    junctions.push_back(*node);
    place.push_back(last);
    return true;
  }

  ByteReader structure_, x_, y_, r_;
  double quantum_ = 1;
  Grid last_root_;
  std::uint32_t component_ = 0;
};

/// A disk's numbers are rounded by half a quantum each: its centre by 1 / sqrt 2 of it.
constexpr double rounding = std::numbers::sqrt2 / 2 + 0.5;

/// Of the axes' extent. The number of disks along a curve grows as the root of one over the error.
constexpr double smallest_error = 1e-9;

/// Where a number takes more than 52 bits in multiples of the quantum.
Error too_far() {
  return {ErrorCode::invalid_option, "the error is too small for the coordinates", {}};
}
Status check_error(double error, const Box& box) {
  if (!(error > 0) || !std::isfinite(error))
    return Error{ErrorCode::invalid_option, "the error is not a positive number", {}};
  if (error < smallest_error * distance(box.low, box.high))
    return Error{ErrorCode::invalid_option, "the error is below 1e-9 of the extent", {}};
  return success();
}

}  // namespace

Result<ShapeCode> encode_axes(std::span<const MedialAxis> axes, const PackOptions& options,
                              PackReport* report) {
  Box box = Box::nothing();
  for (const MedialAxis& axis : axes) box.add(box_of_disks(axis));
  if (Status possible = check_error(options.error, box); !possible)
    return std::move(possible).error();
  if (!(options.quantum_share > 0 && options.quantum_share < 1 - ops::chord_share) ||
      !(options.prune_share > 0 && options.prune_share <= 1 - ops::sample_share))
    return Error{ErrorCode::invalid_option, "a share of the error is out of range", {}};
  const double most = options.quantum_share * options.error / rounding;
  const Head head(most, options.error);
  const double quantum = head.below(most);
  // What rounding, and chords when disks become polygons, leave for the polylines.
  const double left = (1 - ops::chord_share) * options.error - rounding * quantum;
  ShapeCode code;
  ops::put_number(code[0], head.version());
  head.put(code[0], quantum);
  head.put(code[0], -head.below(-options.error));
  ops::put_number(code[0], axes.size());
  AxisEncoder encoder(code, quantum);
  PackReport counted;
  for (const MedialAxis& axis : axes) {
    for (const Node& node : axis.nodes)
      if (!std::isfinite(node.disk.center.x) || !std::isfinite(node.disk.center.y) ||
          !std::isfinite(node.disk.radius))
        return Error{ErrorCode::not_finite, "a disk of the axis is not finite", {}};
    const DiskGraph graph = ops::disk_lines(axis, options.prune_share * left, left);
    counted.disks += graph.junctions.size();
    for (const DiskLine& line : graph.lines) counted.disks += line.disks.size() - 2;
    counted.lines += graph.lines.size();
    if (!encoder.add(graph)) return too_far();
  }
  counted.quantum = quantum;
  if (report != nullptr) *report = counted;
  return code;
}

Result<std::vector<MedialAxis>> decode_axes(const ShapeCode& code) {
  return AxisDecoder(code).run();
}

Result<ShapeCode> encode_boundary(std::span<const Shape> shapes, double error) {
  Box box = Box::nothing();
  for (const Shape& shape : shapes)
    for (const Vec2 p : shape.points) box.add(p);
  if (Status possible = check_error(error, box); !possible) return std::move(possible).error();
  // The best share of the error for rounding; more for it makes longer codes of fewer points.
  constexpr double share = 0.25;
  const double quantum = share * error * std::numbers::sqrt2, left = (1 - share) * error;
  if (!(largest_coordinate_in(box) <= largest * quantum)) return too_far();
  const Head head(quantum, error);
  ShapeCode code;
  ops::put_number(code[0], head.version());
  head.put(code[0], quantum);
  ops::put_number(code[0], shapes.size());
  Grid last;
  for (const Shape& shape : shapes) {
    ops::put_number(code[0], shape.loop_count());
    for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
      std::vector<Vec2> points;
      for (std::size_t k = shape.loop_begin[loop]; k < shape.loop_begin[loop + 1]; ++k) {
        points.push_back(shape.points[k]);
        if (shape.bulge(k) == 0) continue;
        // Arcs as chords within a share of the error.
        const std::size_t next =
            k + 1 == shape.loop_begin[loop + 1] ? shape.loop_begin[loop] : k + 1;
        const BulgeArc arc{shape.points[k], shape.points[next], shape.bulge(k)};
        const double sagitta = 0.5 * std::abs(arc.bulge) * norm(arc.chord());
        const double pieces =
            std::clamp(std::ceil(std::sqrt(sagitta / (ops::chord_share * left))), 1.0, 4096.0);
        for (double i = 1; i < pieces; ++i) points.push_back(point_at_share(arc, i / pieces));
      }
      points.push_back(points.front());
      const auto excess = [&](std::uint32_t i, std::uint32_t first, std::uint32_t end) {
        const Vec2 a = points[first], d = points[end] - a, v = points[i] - a;
        const double size = squared_norm(d);
        const double t = size > 0 ? std::clamp(dot(d, v) / size, 0.0, 1.0) : 0;
        return norm(v - t * d) - (1 - ops::chord_share) * left;
      };
      auto kept = ops::simplified(static_cast<std::uint32_t>(points.size()), excess);
      kept.pop_back();
      ops::put_number(code[0], kept.size());
      for (const std::uint32_t i : kept) {
        const Grid at{std::llround(points[i].x / quantum), std::llround(points[i].y / quantum), 0};
        ops::put_signed(code[1], at.x - last.x);
        ops::put_signed(code[2], at.y - last.y);
        last = at;
      }
    }
  }
  return code;
}

}  // namespace medial

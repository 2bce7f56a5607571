// Contours to rings: each piece on its own, straight pieces and arcs as they are, curves as
// spirals.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/local_frame.h"
#include "base/numbers.h"
#include "base/threads.h"
#include "curve/biarc.h"
#include "curve/spirals.h"
#include "medial/contour.h"
#include "medial/geometry.h"

namespace medial {
namespace {

using namespace curve;

/// Pieces that one task converts.
constexpr std::size_t curves_per_task = 64;

/// The distance that means nothing on a curve with coordinates up to `largest`: what rounding does
/// to points, and to control points that have been halved again and again (each time with one
/// rounding a degree; over the smallest weight, where there are weights).
double rounding_of(const Bezier& curve, double largest) {
  double ratio = 1;
  if (curve.rational) {
    const auto [least, most] =
        std::minmax_element(curve.w.begin(), curve.w.begin() + curve.degree + 1);
    ratio = *most / *least;
  }
  return (8 + 4 * curve.degree * ratio) * std::numeric_limits<double>::epsilon() * largest;
}

/// A joint where directions differ by less is smooth.
constexpr double smooth_joint = 1e-3;
/// Curvatures at a joint that differ by less, relatively, do not jump.
constexpr double jump = 1e-4;

/// One piece, ready to be converted.
struct Piece {
  enum class Kind { segment, arc, straight_curve, curve };
  Kind kind = Kind::segment;
  Vec2 begin_point;
  Vec2 end_point;
  double bulge = 0;
  double rounding = 0;  ///< in units of the input
  // Of curves:
  PieceCoordinates frame;
  Bezier curve;
  // In units of the input:
  Vec2 begin_tangent;
  Vec2 end_tangent;
  double begin_curvature = 0;
  double end_curvature = 0;
};

/// The pieces of a contour that are more than a point, and the one that closes it.
class PieceSource {
 public:
  explicit PieceSource(const Contour& contour) : contour_(contour) {
    const auto last = static_cast<std::uint32_t>(contour.points.size() - 1);
    for (const CurvePiece& piece : contour.pieces) {
      const auto begin = contour.points.begin() + piece.first;
      const Vec2 first = *begin;
      if (std::any_of(begin + 1, begin + piece.degree + 1, [&](Vec2 p) { return p != first; })) {
        pieces_.push_back(piece);
      }
    }
    if (contour.points[last] != contour.points[0]) pieces_.push_back({last, 0, 0});
  }

  std::size_t size() const { return pieces_.size(); }
  void load(std::size_t index, Piece& piece) const;

 private:
  const Contour& contour_;
  std::vector<CurvePiece> pieces_;  ///< degree 0: the closing segment
};

bool is_straight(const Bezier& curve, double rounding) {
  Vec2 axis{0, 0};
  double longest = 0;
  for (int i = 1; i <= curve.degree; ++i) {
    const Vec2 d = curve.point(i) - curve.point(0);
    if (squared_norm(d) > longest) {
      longest = squared_norm(d);
      axis = d;
    }
  }
  const double most = rounding * std::sqrt(longest);
  for (int i = 1; i <= curve.degree; ++i) {
    if (std::abs(cross(axis, curve.point(i) - curve.point(0))) > most) return false;
  }
  return true;
}

PieceCoordinates frame_of_piece(std::span<const Vec2> points) {
  Box half = Box::nothing();
  for (const Vec2 p : points) half.add(0.5 * p);
  const auto [low, high] = half;
  const Vec2 origin{detail::exact_origin(low.x, high.x), detail::exact_origin(low.y, high.y)};
  const double size = std::max({std::abs(low.x - origin.x), std::abs(low.y - origin.y),
                                std::abs(high.x - origin.x), std::abs(high.y - origin.y)});
  int exponent = 0;
  std::frexp(size, &exponent);
  exponent = std::clamp(exponent, -1000, 1023);
  return {origin, std::ldexp(1.0, -exponent), std::ldexp(1.0, exponent)};
}

void PieceSource::load(std::size_t index, Piece& piece) const {
  const CurvePiece source = pieces_[index];
  const bool closing = source.degree == 0;
  const std::span<const Vec2> points =
      std::span(contour_.points).subspan(source.first, closing ? 1 : source.degree + 1);
  piece.begin_point = points[0];
  piece.end_point = closing ? contour_.points[0] : points.back();
  piece.bulge = source.bulge;
  if (source.degree <= 1) {
    piece.kind = source.bulge == 0 ? Piece::Kind::segment : Piece::Kind::arc;
    // In halves, which cannot overflow.
    const Arc half{0.5 * piece.begin_point, 0.5 * piece.end_point, source.bulge};
    piece.begin_tangent = tangent_at_begin(half);
    piece.end_tangent = tangent_at_end(half);
    piece.begin_curvature = piece.end_curvature = 0.5 * curvature(half);
    return;
  }

  piece.frame = frame_of_piece(points);
  double largest = 0;
  for (Vec2 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  std::array<Vec2, max_degree + 1> local;
  for (std::size_t i = 0; i < points.size(); ++i) local[i] = piece.frame.to_local(points[i]);
  const std::span<const double> weights =
      contour_.weights.empty() ? std::span<const double>()
                               : std::span(contour_.weights).subspan(source.first, points.size());
  piece.curve = make_bezier(std::span(local).first(points.size()), weights);
  piece.rounding = rounding_of(piece.curve, largest);
  const double local_rounding = piece.frame.local_length(piece.rounding);
  if (is_straight(piece.curve, local_rounding)) {
    piece.kind = Piece::Kind::straight_curve;
    piece.begin_curvature = piece.end_curvature = 0;
    return;
  }
  piece.kind = Piece::Kind::curve;
  const Station begin = station_at(piece.curve, 0, Side::after);
  const Station end = station_at(piece.curve, 1, Side::before);
  piece.begin_tangent = begin.tangent;
  piece.end_tangent = end.tangent;
  piece.begin_curvature = piece.frame.local_length(begin.curvature);
  piece.end_curvature = piece.frame.local_length(end.curvature);
}

/// What the curvature of the arc at a smooth joint must not exceed, in units of the input: halfway
/// up to the neighbour, if curvature jumps up there.
double curvature_limit(double own, double neighbour, Vec2 own_tangent, Vec2 neighbour_tangent) {
  const bool smooth = dot(own_tangent, neighbour_tangent) > 0 &&
                      std::abs(cross(own_tangent, neighbour_tangent)) < smooth_joint;
  const bool jumps = std::abs(neighbour) > (1 + jump) * std::abs(own) && own * neighbour > 0 &&
                     std::isfinite(neighbour);
  return smooth && jumps ? 0.5 * (std::abs(own) + std::abs(neighbour)) : infinity;
}

/// What one task makes of some neighbouring pieces of one contour.
struct Chunk {
  std::size_t contour = 0;
  std::size_t first = 0;
  std::size_t count = 0;
  ArcChain chain;
  double error = 0;
  double floor = 0;  ///< no tolerance below this was met
};

/// A curve on a line, as the segments between the points where it turns back.
void append_straight(const Piece& piece, ArcChain& chain) {
  chain.points.push_back(piece.begin_point);
  chain.bulges.push_back(0);
  const Bezier& curve = piece.curve;
  Vec2 axis{0, 0};
  for (int i = 1; i <= curve.degree; ++i) {
    const Vec2 d = curve.point(i) - curve.point(0);
    if (squared_norm(d) > squared_norm(axis)) axis = d;
  }
  Fixed<double, max_degree + 1> along, weight;
  bool rising = true, falling = true;
  for (int i = 0; i <= curve.degree; ++i) {
    along[i] = axis.x * curve.x[i] + axis.y * curve.y[i];
    weight[i] = curve.weight(i);
    if (i == 0) continue;
    const double step = along[i] / weight[i] - along[i - 1] / weight[i - 1];
    rising = rising && step >= 0;
    falling = falling && step <= 0;
  }
  if (rising || falling) return;
  const Polynomial x = from_bernstein(along.data(), curve.degree);
  const Polynomial w = from_bernstein(weight.data(), curve.degree);
  const Roots turns = roots(sum(product(derivative(x), w), -1, product(x, derivative(w))));
  for (int i = 0; i < turns.count; ++i) {
    if (turns.t[i] <= 0 || turns.t[i] >= 1) continue;
    chain.points.push_back(piece.frame.to_input(evaluate(curve, turns.t[i]).point));
    chain.bulges.push_back(0);
  }
}

void convert(const PieceSource& source, double tolerance, Chunk& chunk) {
  Piece pieces[3];
  const std::size_t n = source.size();
  Piece *before = &pieces[0], *piece = &pieces[1], *after = &pieces[2];
  source.load((chunk.first + n - 1) % n, *before);
  source.load(chunk.first, *piece);
  for (std::size_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
    source.load((i + 1) % n, *after);
    ArcChain& chain = chunk.chain;
    if (piece->kind == Piece::Kind::curve) {
      const PieceCoordinates& frame = piece->frame;
      const double rounding = frame.local_length(piece->rounding);
      SpiralOptions options;
      options.rounding = rounding;
      options.tolerance = std::max(frame.local_length(tolerance) - 0.5 * rounding, rounding);
      options.limits.begin =
          frame.input_length(curvature_limit(piece->begin_curvature, before->end_curvature,
                                             piece->begin_tangent, before->end_tangent));
      options.limits.end = frame.input_length(curvature_limit(
          piece->end_curvature, after->begin_curvature, piece->end_tangent, after->begin_tangent));
      const std::size_t begin = chain.points.size();
      const double error = append_spirals(piece->curve, frame, options, chain);
      chunk.floor = std::max(chunk.floor, 1.5 * piece->rounding);
      // The rounding of end points comes on top of what was measured.
      chunk.error = std::max(chunk.error, frame.input_length(error) + 0.5 * piece->rounding);
      if (chain.points.size() > begin) chain.points[begin] = piece->begin_point;
    } else if (piece->kind == Piece::Kind::straight_curve) {
      append_straight(*piece, chain);
    } else {
      chain.points.push_back(piece->begin_point);
      chain.bulges.push_back(piece->bulge);
    }
    Piece* const reused = before;
    before = piece;
    piece = after;
    after = reused;
  }
}

Error error_in(ErrorCode code, const char* text, std::size_t contour) {
  Error error{code, text, {}};
  error.place.ring = contour;
  return error;
}

/// Whether the pieces are those of the points, end to end.
std::optional<Error> fault_of(const Contour& contour, std::size_t index) {
  const auto at_point = [&](ErrorCode code, const char* text, std::size_t point) {
    Error error = error_in(code, text, index);
    error.place.vertex = point;
    error.place.point = contour.points[point];
    return error;
  };
  if (contour.points.empty()) {
    return error_in(ErrorCode::no_area, "the contour has no points", index);
  }
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    if (!std::isfinite(contour.points[i].x) || !std::isfinite(contour.points[i].y)) {
      return at_point(ErrorCode::not_finite, "a coordinate is not a finite number", i);
    }
  }
  if (!contour.weights.empty() && contour.weights.size() != contour.points.size()) {
    return error_in(ErrorCode::malformed, "a contour needs a weight for each point, or none",
                    index);
  }
  for (std::size_t i = 0; i < contour.weights.size(); ++i) {
    // Ratios of weights are squared and multiplied.
    constexpr double most = 1e12;
    if (!std::isfinite(contour.weights[i])) {
      return at_point(ErrorCode::not_finite, "a weight is not a finite number", i);
    }
    if (!(contour.weights[i] > 0)) {
      return at_point(ErrorCode::unsupported, "a weight is not positive", i);
    }
    const double ratio = contour.weights[i] / contour.weights[i == 0 ? 0 : i - 1];
    if (!(ratio <= most && ratio >= 1 / most)) {
      return at_point(ErrorCode::unsupported, "a weight is far larger than its neighbour", i);
    }
  }
  std::size_t next = 0;
  for (const CurvePiece& piece : contour.pieces) {
    if (piece.first != next || piece.degree == 0 || piece.degree >= contour.points.size() - next) {
      return error_in(ErrorCode::malformed, "the pieces of a contour are not end to end", index);
    }
    if (piece.degree > max_degree) {
      return at_point(ErrorCode::unsupported, "a curve has a degree above 32", next);
    }
    if (!std::isfinite(piece.bulge)) {
      return at_point(ErrorCode::not_finite, "a bulge is not a finite number", next);
    }
    next += piece.degree;
  }
  if (next + 1 != contour.points.size()) {
    return error_in(ErrorCode::malformed, "a contour has points that no piece uses", index);
  }
  return std::nullopt;
}

/// Half of the bounding box' diagonal: the whole may be too large for a double.
double half_diagonal_of(std::span<const Contour> contours) {
  Box half = Box::nothing();
  for (const Contour& contour : contours)
    for (const Vec2 p : contour.points) half.add(0.5 * p);
  return diagonal(half);
}

/// The tolerance in units of the input.
double tolerance_of(std::span<const Contour> contours, const ArcOptions& options) {
  if (options.tolerance && !options.relative) return *options.tolerance;
  constexpr double default_share = 1e-6;
  return std::min(2 * (options.tolerance.value_or(default_share) * half_diagonal_of(contours)),
                  std::numeric_limits<double>::max());
}

}  // namespace

Result<std::vector<Ring>> approximate_by_arcs(std::span<const Contour> contours,
                                              const ArcOptions& options, ArcReport* report) {
  const double asked = options.tolerance.value_or(1);
  if (!(asked > 0) || !std::isfinite(asked) || options.threads < 0 ||
      options.threads > most_threads) {
    return Error{ErrorCode::invalid_option, "a tolerance of arcs must be positive", {}};
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (auto error = fault_of(contours[i], i)) return *error;
  }
  const double tolerance = tolerance_of(contours, options);

  std::vector<PieceSource> sources;
  sources.reserve(contours.size());
  std::vector<Chunk> chunks;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    sources.emplace_back(contours[i]);
    const std::size_t pieces = sources.back().size();
    for (std::size_t first = 0; first < pieces; first += curves_per_task) {
      chunks.push_back({i, first, std::min(curves_per_task, pieces - first), {}, 0, 0});
    }
  }
  const auto convert_chunk = [&](std::size_t i) {
    convert(sources[chunks[i].contour], tolerance, chunks[i]);
  };
  if (chunks.size() == 1 || options.threads == 1) {
    for (std::size_t i = 0; i < chunks.size(); ++i) convert_chunk(i);
  } else {
    on_threads(options.threads, [&] { parallel_for(chunks.size(), convert_chunk); });
  }

  std::vector<Ring> rings(contours.size());
  std::vector<std::size_t> sizes(contours.size(), 0);
  for (const Chunk& chunk : chunks) sizes[chunk.contour] += chunk.chain.points.size();
  ArcReport done;
  done.tolerance = tolerance;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    rings[i].role = contours[i].role;
    rings[i].points.reserve(sizes[i]);
    rings[i].bulges.reserve(sizes[i]);
    done.pieces += contours[i].pieces.size();
  }
  for (const Chunk& chunk : chunks) {
    Ring& ring = rings[chunk.contour];
    const ArcChain& chain = chunk.chain;
    ring.points.insert(ring.points.end(), chain.points.begin(), chain.points.end());
    ring.bulges.insert(ring.bulges.end(), chain.bulges.begin(), chain.bulges.end());
    for (double bulge : chain.bulges) ++(bulge == 0 ? done.segments : done.arcs);
    done.spirals += chain.spirals;
    done.largest_error = std::max(done.largest_error, chunk.error);
    done.tolerance = std::max(done.tolerance, chunk.floor);
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i].points.size() < 2) {
      return error_in(ErrorCode::no_area, "the contour is a point", i);
    }
  }
  if (report != nullptr) *report = done;
  return rings;
}

}  // namespace medial

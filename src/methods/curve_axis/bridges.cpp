#include "methods/curve_axis/bridges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/arc.h"

namespace medial::curve_axis {
namespace {

/// The number of points of a curve that are tried first; the best of them are then improved.
constexpr int samples = 32;
constexpr std::size_t most_improved = 24;
/// No part of a divided piece is shorter than this share of it.
constexpr double least_part = 1e-6;

struct Foot {
  std::size_t loop = 0, piece = 0;
  double share = 0;
};

/// The minimum in [low, high] of a function that first falls and then rises.
template <class F>
double least(const F& f, double low, double high) {
  for (int round = 0; round < 80; ++round) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool first = f(a) < f(b);
    (first ? high : low) = first ? b : a;
  }
  return (low + high) / 2;
}

class Bridges {
 public:
  Bridges(std::span<const Contour> contours, Vec2 direction) : direction_(direction) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < contours.size(); ++i) {
      // The shape is also to the left of holes.
      loops_.push_back(pieces_of(i == 0 ? contours[i] : reversed(contours[i])));
      for (Piece& piece : loops_.back()) piece.source += before;
      before += contours[i].pieces.size();
    }
    cuts_.resize(loops_.size());
  }

  std::vector<Piece> take() {
    for (std::size_t hole = 1; hole < loops_.size(); ++hole) {
      const auto foot = extreme(hole);
      const auto other = foot ? opposite(*foot) : std::nullopt;
      if (!other) return {};
      cuts_[hole].push_back({*foot, hole});
      cuts_[other->loop].push_back({*other, hole});
    }
    for (std::vector<Cut>& cuts : cuts_)
      std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return a.foot.piece != b.foot.piece ? a.foot.piece < b.foot.piece
                                            : a.foot.share < b.foot.share;
      });
    append_loop(0, 0);
    return gaps_ == 2 * (loops_.size() - 1) ? std::move(cycle_) : std::vector<Piece>();
  }

 private:
  struct Cut {
    Foot foot;
    std::size_t bridge;  ///< the number of its hole
  };

  BoundaryPoint at(std::size_t loop, std::size_t piece, double share) const {
    return point_of(loops_[loop][piece], share, 1);
  }
  BoundaryPoint at(const Foot& foot) const { return at(foot.loop, foot.piece, foot.share); }
  static bool is_inside(double share) { return share > least_part && share < 1 - least_part; }

  /// The position of a normal in a fan, as a share.
  static double share_of(const Piece& fan, Vec2 normal) {
    return signed_angle(fan.tangent, -left_of(normal)) / fan.to;
  }

  std::optional<Foot> extreme(std::size_t loop) const {
    const auto height = [&](std::size_t piece, double share) {
      return dot(at(loop, piece, share).point, direction_);
    };
    Foot best{loop, 0, 0};
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t piece = 0; piece < loops_[loop].size(); ++piece)
      for (int i = 0; i <= samples; ++i) {
        const double share = static_cast<double>(i) / samples, here = height(piece, share);
        if (here <= highest) continue;
        highest = here;
        best = {loop, piece, share};
      }
    const Piece* found = &loops_[loop][best.piece];
    if (found->kind == Piece::Kind::curve) {
      best.share = least([&](double share) { return -height(best.piece, share); },
                         std::max(0.0, best.share - 1.0 / samples),
                         std::min(1.0, best.share + 1.0 / samples));
      // The end of a curve is the vertex of the adjacent fan.
      const std::size_t count = loops_[loop].size();
      if (best.share > 1 - least_part) best.piece = (best.piece + 1) % count;
      if (best.share < least_part) best.piece = (best.piece + count - 1) % count;
      found = &loops_[loop][best.piece];
    }
    if (found->kind == Piece::Kind::fan) best.share = share_of(*found, direction_);
    if (!is_inside(best.share)) return std::nullopt;
    return best;
  }

  /// The other foot of the largest disk that touches the boundary at `foot`.
  std::optional<Foot> opposite(const Foot& foot) const {
    const BoundaryPoint here = at(foot);
    const auto radius = [&](Vec2 p) {
      const Vec2 way = p - here.point;
      const double ahead = dot(way, here.normal());
      return ahead > 0 ? squared_norm(way) / (2 * ahead) : std::numeric_limits<double>::infinity();
    };
    struct Candidate {
      double radius;
      Foot foot;
    };
    std::vector<Candidate> all;
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
      for (std::size_t piece = 0; piece < loops_[loop].size() && loop != foot.loop; ++piece) {
        Candidate best{std::numeric_limits<double>::infinity(), {}};
        for (int i = 0; i <= samples; ++i) {
          const double share = static_cast<double>(i) / samples;
          const double r = radius(at(loop, piece, share).point);
          if (r < best.radius) best = {r, {loop, piece, share}};
        }
        if (std::isfinite(best.radius)) all.push_back(best);
      }
    const auto is_smaller = [](const Candidate& a, const Candidate& b) {
      return a.radius < b.radius;
    };
    const std::size_t count = std::min(all.size(), most_improved);
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                      is_smaller);
    all.resize(count);
    for (Candidate& one : all) {
      const auto of_share = [&](double share) {
        return radius(at(one.foot.loop, one.foot.piece, share).point);
      };
      if (loops_[one.foot.loop][one.foot.piece].kind == Piece::Kind::fan) {
        one.radius *= 1 - 1e-12;  // prefer the fan to the ends of the adjacent curves
        continue;
      }
      one.foot.share = least(of_share, std::max(0.0, one.foot.share - 1.0 / samples),
                             std::min(1.0, one.foot.share + 1.0 / samples));
      one.radius = of_share(one.foot.share);
    }
    const auto best = std::min_element(all.begin(), all.end(), is_smaller);
    if (best == all.end()) return std::nullopt;
    Foot other = best->foot;
    const Piece& piece = loops_[other.loop][other.piece];
    if (piece.kind == Piece::Kind::fan)
      other.share = share_of(piece, here.point + radius(piece.point) * here.normal() - piece.point);
    else
      other.share = stabilised(here, other);
    if (!is_inside(other.share)) return std::nullopt;
    return other;
  }

  /// Newton's method on (14), with one foot fixed.
  double stabilised(const BoundaryPoint& held, Foot foot) const {
    for (int round = 0; round < 20; ++round) {
      const BoundaryPoint here = at(foot);
      const Vec2 chord = held.point - here.point, sum = here.tangent - held.tangent;
      const double slope = here.turn * dot(chord, here.normal()) - dot(here.tangent, sum);
      const double move = dot(chord, sum) / (slope * here.speed);
      if (!(std::abs(move) < 1)) return 0;
      foot.share -= move;
      if (std::abs(move) < 1e-16) break;
    }
    return foot.share;
  }

  void append(std::size_t loop, std::size_t piece, double from, double to) {
    Piece part = loops_[loop][piece];
    const double whole = part.to - part.from;
    part.to = part.from + to * whole;
    part.from += from * whole;
    cycle_.push_back(part);
  }

  /// Appends the boundary from one foot to the next, once around the loop if they are the same.
  void append_way(const Foot& from, const Foot& to) {
    std::size_t piece = from.piece;
    double share = from.share;
    while (true) {
      const bool ends = piece == to.piece && to.share > share;
      append(from.loop, piece, share, ends ? to.share : 1);
      if (ends) return;
      piece = (piece + 1) % loops_[from.loop].size();
      share = 0;
      if (piece == to.piece && to.share == 0) return;
    }
  }

  void append_gap(std::size_t bridge) {
    Piece gap;
    gap.kind = Piece::Kind::gap;
    gap.source = bridge;
    cycle_.push_back(gap);
    ++gaps_;
  }

  /// Appends a loop, starting at its cut at this bridge or at its beginning, with the loops that
  /// its other cuts lead to.
  void append_loop(std::size_t loop, std::size_t bridge) {
    const std::vector<Cut>& cuts = cuts_[loop];
    std::size_t entry = 0;
    while (entry < cuts.size() && cuts[entry].bridge != bridge) ++entry;
    const bool enters = entry < cuts.size();
    const Foot start = enters ? cuts[entry].foot : Foot{loop, 0, 0};
    Foot here = start;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const Cut& cut = cuts[((enters ? entry + 1 : 0) + k) % cuts.size()];
      if (cut.bridge == bridge) continue;
      append_way(here, cut.foot);
      append_gap(cut.bridge);
      append_loop(loop_beyond(loop, cut.bridge), cut.bridge);
      append_gap(cut.bridge);
      here = cut.foot;
    }
    append_way(here, start);
  }

  std::size_t loop_beyond(std::size_t loop, std::size_t bridge) const {
    if (loop != bridge) return bridge;
    std::size_t other = 0;
    while (other == loop || std::none_of(cuts_[other].begin(), cuts_[other].end(),
                                         [&](const Cut& cut) { return cut.bridge == bridge; }))
      ++other;
    return other;
  }

  Vec2 direction_;
  std::vector<std::vector<Piece>> loops_;
  std::vector<std::vector<Cut>> cuts_;
  std::vector<Piece> cycle_;
  std::size_t gaps_ = 0;
};

}  // namespace

std::vector<Piece> bridged(std::span<const Contour> loops, Vec2 direction) {
  return Bridges(loops, direction).take();
}

}  // namespace medial::curve_axis

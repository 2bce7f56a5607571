#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/shape.h"
#include "methods/potential/moments.h"

namespace medial::potential {

/// A charged segment of the boundary: straight, with charge density 1, and the interior on its
/// left.
struct Charge {
  Vec2 start;
  Vec2 end;
  std::uint32_t site = 0;  ///< a number that the caller chooses
  bool first = true;       ///< the first piece of its edge
  bool last = true;        ///< the last piece of its edge
};

/// The charged boundary of one region: its pieces, ordered so that neighbours in space are
/// adjacent, and a tree of moments over them.
class Charges {
 public:
  /// Requires pieces of positive length. O(n log n).
  explicit Charges(const std::vector<Charge>& pieces);

  /// A set of adjacent pieces, to be summed from afar.
  struct Node {
    std::uint32_t begin = 0, end = 0;  ///< charges
    std::uint32_t right = 0;  ///< second child; the first one follows its parent; 0: a leaf
    Box box;
    double length = 0;  ///< the charge
    Vec2 center;        ///< of the charge
    double radius = 0;  ///< of a disk around `center` that contains the whole charge
  };

  struct Nearest {
    double distance = 0;
    std::uint32_t piece = 0;  ///< index among the given pieces
  };
  /// The piece nearest to p; the lowest among equals. O(log n) for sensible borders.
  Nearest nearest(Vec2 p) const;

  /// The nearest point of the boundary ahead of a reflex corner p, at least 90 degrees away from
  /// both edges, which leave p in the directions a and b; p itself if there is none. O(log n) for
  /// sensible boundaries.
  Vec2 nearest_ahead(Vec2 p, Vec2 a, Vec2 b) const;

  static constexpr std::uint32_t leaf_size = 16;
  /// From p to each of the pieces begin .. end - 1, of which there are at most leaf_size.
  void squared_distances(Vec2 p, std::uint32_t begin, std::uint32_t end,
                         std::span<double, leaf_size> squares) const;

  std::size_t size() const { return lengths.size(); }
  double length() const { return nodes.front().length; }
  Vec2 start(std::size_t i) const { return {start_x[i], start_y[i]}; }
  Vec2 tangent(std::size_t i) const { return {tangent_x[i], tangent_y[i]}; }

  std::vector<double> start_x, start_y;      ///< of each piece: where it begins,
  std::vector<double> tangent_x, tangent_y;  ///< its unit tangent,
  std::vector<double> lengths;               ///< its length
  std::vector<Node> nodes;                   ///< the root is the first
  std::vector<Moments>
      moments;  ///< of each node about its centre; stored apart, as most nodes are only passed

 private:
  /// Visits leaves closer than the root of `limit`, which may shrink meanwhile, roughly by
  /// distance.
  template <class Visit>
  void from_near(Vec2 p, const double& limit, const Visit& visit) const;
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> piece_;  ///< the index of each among the given pieces
};

}  // namespace medial::potential

#pragma once

#include <limits>
#include <optional>

#include "methods/potential/force.h"
#include "methods/potential/skeleton.h"

namespace medial::potential {

struct SuccessorOptions {
  double order = 0;     ///< of the force; 0: adaptive for each point
  double angle = 0;     ///< theta_min, in radians
  double movement = 0;  ///< e_min: the largest move of a point by a higher order
  double step = 0;      ///< S, the first step of the search
  double accuracy = 0;  ///< s_min, where the search ends
  /// The longest way to a valley. If the points come from the limit of high orders, further valleys
  /// belong to other branches.
  double furthest = std::numeric_limits<double>::infinity();
  double least_order = 1;  ///< of the valley that the points are on: adaptive orders begin here
  double most_order = largest_order;  ///< the end of adaptive orders
};

/// A point of the medial axis, and the order of the force with which it was found.
struct Successor {
  Vec2 place;
  double radius = 0;
  double order = 1;
};

/// N of the algorithm MAT-Generalized-Polygonal, Steps 0 to 2, at a place: the lowest order from 2
/// on at which the force's direction changes by no more than theta_min, both to this order and to
/// the next one. At most `most`, which is at most most_searched_order. Call evaluator.place()
/// first.
int adaptive_order(Evaluator& evaluator, double angle, int most);
constexpr int most_searched_order = 64;

/// The minimum of the potential of the final order (the highest one, if adaptive) near a minimum of
/// a lower order; the place of the latter if there is none within a quarter of its radius.
Vec2 minimum_near(Evaluator& evaluator, const ValleyPoint& minimum,
                  const SuccessorOptions& options);

/// The largest move of a point, as a share of its radius: if no valley is closer, there is none to
/// follow.
constexpr double widest_move = 0.25;

/// Algorithm Successor: the point of the n-skeleton across the valley at `point`. Takes steps of at
/// most S until the n-force turns around, and then searches between two places; none if the force
/// does not turn. `guess`: where to look first, to the left of the valley.
std::optional<Vec2> valley_across(Evaluator& evaluator, const ValleyPoint& point, double order,
                                  const SuccessorOptions& options, double guess = 0);

/// The same; the point's own place if there is none.
Vec2 successor(Evaluator& evaluator, const ValleyPoint& point, double order,
               const SuccessorOptions& options, double guess = 0);

/// Algorithm MAT-Generalized-Polygonal for one point, repeated with twice the order until the point
/// moves by no more than e_min, each time across the force of the previous order. The error of a
/// valley decreases as 1 / n, so the last move approximates the remaining error. With a fixed
/// order, only algorithm Successor.
Successor generalized_successor(Evaluator& evaluator, const ValleyPoint& point,
                                const SuccessorOptions& options);

}  // namespace medial::potential

#pragma once

#include <limits>
#include <optional>

#include "methods/potential/force.h"
#include "methods/potential/skeleton.h"

namespace medial::potential {

struct SuccessorOptions {
  double order = 0;     ///< of the force; 0: adaptive for each point
  double angle = 0;     ///< theta_min, in radians
  double movement = 0;  ///< e_min: what a higher order may still move a point by
  double step = 0;      ///< S, the first step of the search
  double accuracy = 0;  ///< s_min, where the search ends
  /// The longest way to a valley; further ones are other branches' where the points come from the
  /// limit of high orders.
  double furthest = std::numeric_limits<double>::infinity();
  double least_order = 1;  ///< of the valley that the points are on: adaptive orders begin there
  double most_order = largest_order;  ///< of them
};

/// A point of the medial axis and the order of the force that it was found with.
struct Successor {
  Vec2 place;
  double radius = 0;
  double order = 1;
};

/// N of the algorithm MAT-Generalized-Polygonal, Steps 0 to 2, at a place: the lowest order from 2
/// on at which the force's direction, and at the next order again, changes by no more than
/// theta_min. At most `most`, which is at most most_searched_order. Requires evaluator.place() at
/// the place before.
int adaptive_order(Evaluator& evaluator, double angle, int most);
constexpr int most_searched_order = 64;

/// The minimum of the potential of the final order (the highest, where that is adaptive) near one
/// of a lower order; the latter's place where there is none within a quarter of its radius.
Vec2 minimum_near(Evaluator& evaluator, const ValleyPoint& minimum,
                  const SuccessorOptions& options);

/// How far a point moves at most, as a share of its radius: where no valley is nearer there is none
/// to follow.
constexpr double widest_move = 0.25;

/// Algorithm Successor: the point of the n-skeleton across the valley at `point`, by steps of S at
/// most until the n-force turns around, and between two places then; nothing where it does not.
/// `guess`: where to look first, to the left of the valley.
std::optional<Vec2> valley_across(Evaluator& evaluator, const ValleyPoint& point, double order,
                                  const SuccessorOptions& options, double guess = 0);

/// The same, or the point's own place.
Vec2 successor(Evaluator& evaluator, const ValleyPoint& point, double order,
               const SuccessorOptions& options, double guess = 0);

/// Algorithm MAT-Generalized-Polygonal for one point, repeated with twice the order until the point
/// moves by no more than e_min, each time across the force of the order before. What a valley is
/// off falls as 1 / n, so the last move is about what is left. With a fixed order, algorithm
/// Successor alone.
Successor generalized_successor(Evaluator& evaluator, const ValleyPoint& point,
                                const SuccessorOptions& options);

}  // namespace medial::potential

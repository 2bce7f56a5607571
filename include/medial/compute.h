#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// How an axis is computed. All methods return the same graph.
enum class Method : std::uint8_t {
  disks,     ///< walks along the axis; asks a tree over the boundary. The fastest; holes, threads
  biarc_dc,  ///< the randomised divide and conquer of Aichholzer et al. as published: one thread
             ///< and shapes without holes only, O(n log n) to O(n^2)
  lee,       ///< Lee's divide and conquer: merges Voronoi diagrams of lists of segments and reflex
             ///< vertices; shapes of straight edges without holes only, threads
};

/// The name of a method on the command line and in MedialAxis::method: "disks", "biarc-dc", "lee".
const char* name_of(Method method);
/// The method of that name, if there is one.
std::optional<Method> method_from(std::string_view name);

struct Options {
  Method method = Method::disks;
  /// Disks whose residuals stay below this count as touching. Relative to the diagonal of the
  /// bounding box, in (0, 1e-3]; 0: the default, 4e-15, or what the coordinates' own spacing allows
  /// where the shape lies far from the origin.
  double tolerance = 0;
  /// Where two edges meet at a convex angle and one of them is an arc, the joint is smooth, no
  /// corner, if the directions differ by less than this; in degrees, in [0, 10].
  double corner_angle = 0.01;
  /// Threads to use, at most 1024; 0: all of the machine. The result is the same, byte for byte.
  int threads = 0;
  /// Of the random choices of biarc_dc: the same seed gives the same result, byte for byte.
  std::uint64_t seed = 1;
  /// Called now and then, from any thread and out of order, with the share of the boundary that the
  /// walk is done with, in [0, 1]; in the end with 1. What comes before the walk (sites, holes,
  /// tree) counts as 0, what comes after it as 1: together less than half of the time. Must not
  /// throw.
  std::function<void(double)> progress = {};
  /// When set to true, compute() returns ErrorCode::cancelled as soon as it can: at once during the
  /// walk, and otherwise at the end of the phase. Set too late it changes nothing but the result.
  const std::atomic<bool>* cancel = nullptr;
};

/// The exact medial axis transform of a shape; by the method `disks` O(n log n) expected.
///
/// The graph has one connected part for each component of the shape and exactly one independent
/// cycle for each hole. Errors: invalid_option, cancelled,
/// empty, too_large, unsupported (a coordinate above 1e100 in size, or one that is not zero but
/// below 1e-100, or below that share of the largest; holes, for biarc_dc
/// and lee; arcs, for lee), malformed (a shape that
/// build_shape() did not make), out_of_memory, internal.
Result<MedialAxis> compute(const Shape& shape, const Options& options = {});

}  // namespace medial

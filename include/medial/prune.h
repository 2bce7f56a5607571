#pragma once

// Pruning: the part of an axis that matters, by measures from the literature without a unit
// (docs/prune.md). For axes of any method; edges of exact ones are cut exactly.

#include <string_view>

#include "medial/centreline.h"

namespace medial {

/// How much a point of the axis matters. Beyond a point lies what removing it would cut off from
/// the centre (the deepest disk of a tree, or the cycles). r is the radius of the disk, R that of
/// the deepest disk of the connected part. Measures of points cut an edge where it passes the
/// threshold. Measures of branches judge them at their inner end and drop whole ones.
enum class PruneMeasure : std::uint8_t {
  prominence,    ///< branches: the geometric mean of significance and of the same by R
  significance,  ///< branches: how far the shape reaches out beyond the disk, by r (Ho and Dyer)
  length,        ///< branches: the longest way along the axis to an end beyond, by r
  ratio,         ///< branches: the length of the boundary beyond by the chord between the two feet
  radius,        ///< points: the radius, by R
  angle,         ///< points: the angle between the radii to the feet, in degrees, at most 180
  erosion,    ///< points: how far the shape reaches out beyond the disk, by R (Shaked, Bruckstein)
  potential,  ///< points: the length of the boundary beyond, by 2 pi R (Ogniewicz and Kuebler)
  residual,   ///< points: that length less the chord between the feet, by 2 R (the same)
  area,       ///< points: the area that the shape loses, by the area of the connected part
  lambda,     ///< points: the smallest radius around the feet, by R (Chazal, Lieutier)
  scale,      ///< points: grown by this factor >= 1, another grown disk covers it (Giesen et al.)
};

const std::vector<PruneMeasure>& prune_measures();  ///< all measures; their names as spelled above
const char* name_of(PruneMeasure measure);
std::optional<PruneMeasure> prune_measure_from(std::string_view name);
double default_threshold(PruneMeasure measure);  ///< drops noise, keeps what a person would draw

struct PruneOptions {
  PruneMeasure measure = PruneMeasure::prominence;
  std::optional<double> threshold = {};  ///< nothing: the default of the measure
  /// In place of a threshold: keep at most this many branches, those that matter most. More stay
  /// only where the cycles alone, which always stay, have more.
  std::optional<std::uint64_t> keep = {};
  bool tips = false;  ///< extend each end to a tip, along the way that reaches farthest
};

/// Branches as branches() counts them.
struct PruneReport {
  double threshold = 0;  ///< what was kept matters at least so much
  std::uint64_t edges_before = 0, edges = 0, branches_before = 0, branches = 0;
  std::uint64_t cuts = 0;  ///< edges cut in their inside
};

/// How much every point of an axis, which must live longer, matters by one measure: never less than
/// anything beyond it. So any threshold keeps connected parts and cycles, of a tree at least its
/// deepest disk, and a larger one keeps a subset. O(n), for `scale` O(n log n) expected.
class PruneOrder {
 public:
  PruneOrder(const MedialAxis& axis, PruneMeasure measure, bool tips = false);
  /// The largest threshold that keeps some of an edge. Infinite on cycles and between them.
  double of_edge(std::uint32_t edge) const;
  /// What matters at least `threshold`, by increasing edge; as an axis with nodes and edges in
  /// their order and all sites; its branches, and its edges that are cut in their inside. O(n).
  std::vector<PathPiece> parts(double threshold) const;
  MedialAxis at(double threshold) const;
  std::uint64_t branches_at(double threshold) const;
  std::uint64_t cuts_at(double threshold) const;
  /// The lowest threshold that keeps at most that many branches, or else the fewest. O(n log n).
  double threshold_of(std::uint64_t branches) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// PruneOrder::at() the threshold. Errors: invalid_option (it is negative, NaN, or with branches).
Result<MedialAxis> prune(const MedialAxis& axis, const PruneOptions& options = {},
                         PruneReport* report = nullptr);

}  // namespace medial

#pragma once

// Pruning: the part of an axis that matters, by dimensionless measures from the literature
// (docs/prune.md). For axes of any method; edges of exact axes are cut exactly.

#include <string_view>

#include "medial/centreline.h"

namespace medial {

/// How much a point of the axis matters. "Beyond" a point is the part that removing it would cut
/// off from the centre (the deepest disk of a tree, or the cycles). r is the radius of the disk, R
/// that of the deepest disk of the connected part. Measures of points cut edges at the threshold.
/// Measures of branches rate a branch at its inner end and drop whole branches.
enum class PruneMeasure : std::uint8_t {
  prominence,    ///< branches: the geometric mean of significance and of significance times r / R
  significance,  ///< branches: how far the shape extends beyond the disk, / r (Ho and Dyer)
  length,        ///< branches: the longest path along the axis to an end beyond, / r
  ratio,         ///< branches: the length of the boundary beyond / the chord between the feet
  radius,        ///< points: the radius / R
  angle,         ///< points: the angle between the radii to the feet, in degrees, at most 180
  erosion,       ///< points: how far the shape extends beyond the disk, / R (Shaked, Bruckstein)
  potential,     ///< points: the length of the boundary beyond / 2 pi R (Ogniewicz and Kuebler)
  residual,      ///< points: that length less the chord between the feet, / 2 R (the same)
  area,          ///< points: the area that the shape loses / the area of the connected part
  lambda,  ///< points: the radius of the smallest circle around the feet / R (Chazal, Lieutier)
  scale,   ///< points: the factor >= 1 at which another scaled disk covers it (Giesen et al.)
};

const std::vector<PruneMeasure>& prune_measures();  ///< all of them; name_of() as spelled above
const char* name_of(PruneMeasure measure);
std::optional<PruneMeasure> prune_measure_from(std::string_view name);
double default_threshold(PruneMeasure measure);  ///< drops noise, keeps what a person would draw

struct PruneOptions {
  PruneMeasure measure = PruneMeasure::prominence;
  std::optional<double> threshold = {};  ///< empty: the default of the measure
  /// Instead of a threshold: keep at most this many branches, and all cycles.
  std::optional<std::uint64_t> keep = {};
  bool tips = false;  ///< extend each end to a tip, along the path with the largest reach
};

/// Counts branches like branches().
struct PruneReport {
  double threshold = 0;  ///< everything kept matters at least this much
  std::uint64_t edges_before = 0, edges = 0, branches_before = 0, branches = 0;
  std::uint64_t cuts = 0;  ///< edges cut between their nodes
};

/// How much every point of an axis matters by one measure: never less than anything beyond it. So
/// any threshold keeps parts connected, cycles, and of a tree its deepest disk; a larger threshold
/// keeps a subset. Refers to the axis. O(n); for `scale` O(n log n) expected.
class PruneOrder {
 public:
  PruneOrder(const MedialAxis& axis, PruneMeasure measure, bool tips = false);
  /// The largest threshold that keeps a part of the edge. Infinite on cycles and between them.
  double of_edge(std::uint32_t edge) const;
  /// The part that matters at least `threshold`: as pieces, by increasing edge; as an axis with all
  /// sites, and nodes and edges in order; its number of branches; of edges cut inside. O(n).
  std::vector<PathPiece> parts(double threshold) const;
  MedialAxis at(double threshold) const;
  std::uint64_t branches_at(double threshold) const;
  std::uint64_t cuts_at(double threshold) const;
  /// The lowest threshold that keeps at most `branches`, or else the fewest possible. O(n log n).
  double threshold_of(std::uint64_t branches) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// PruneOrder::at() the threshold. Errors: invalid_option (it is negative, NaN, or with `keep`).
Result<MedialAxis> prune(const MedialAxis& axis, const PruneOptions& options = {},
                         PruneReport* report = nullptr);

}  // namespace medial

#pragma once

// Pruning: the part of an axis that matters, by one of several measures from the literature, each
// without a unit. For the axis of any engine; edges of an exact axis are cut exactly.
// docs/prune.md tells which measure is whose.

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "medial/axis.h"
#include "medial/centreline.h"
#include "medial/error.h"

namespace medial {

/// What tells how much a point of the axis matters. Beyond a point means: what removing it would
/// cut off, away from the centre (the deepest disk of a tree, or the cycles). R is the radius of
/// the deepest disk of the connected part.
///
/// Measures of points: an edge is cut where it passes the threshold.
/// Measures of branches: a branch stays or goes as a whole, judged where it begins, at the disk of
/// its inner end with the radius r; what hangs on a branch that goes, goes too.
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
  lambda,     ///< points: the radius of the smallest circle around the feet, by R (Chazal,
              ///< Lieutier)
  scale,      ///< points: the factor that makes the disk, grown by it, vanish in another disk,
              ///< grown as well; at least 1 (Giesen et al.)
};

/// The name of a measure on the command line, as it is spelled above; all of them; and back.
const char* name_of(PruneMeasure measure);
const std::vector<PruneMeasure>& prune_measures();
std::optional<PruneMeasure> prune_measure_from(std::string_view name);
/// A threshold under which noise goes and what a person would draw stays.
double default_threshold(PruneMeasure measure);

struct PruneOptions {
  PruneMeasure measure = PruneMeasure::prominence;
  std::optional<double> threshold = {};  ///< nothing: the default of the measure
  /// Keep at most so many branches instead, those that matter most; more only where the cycles
  /// consist of more.
  std::optional<std::uint64_t> keep = {};
  /// What is kept runs on to its tips: from each end along the way that reaches farthest.
  bool tips = false;
};

/// What prune() did; branches as branches() counts them.
struct PruneReport {
  double threshold = 0;  ///< what was kept matters at least so much
  std::uint64_t edges_before = 0, edges = 0;
  std::uint64_t branches_before = 0, branches = 0;
  std::uint64_t cuts = 0;  ///< edges cut in their inside
};

/// How much every point of an axis matters by one measure: never less than anything beyond it. So
/// what matters at least so much is a connected part of every connected part, holds all cycles and
/// the ways between them, or at least the deepest disk of a tree (the lowest index among equals;
/// where that disk lies inside an edge between two arcs, the edge), and is a subset of what matters
/// less.
///
/// Keeps a reference to the axis, which must live longer. O(n), for `scale` O(n log n) expected.
class PruneOrder {
 public:
  PruneOrder(const MedialAxis& axis, PruneMeasure measure, bool tips = false);
  ~PruneOrder();
  PruneOrder(PruneOrder&&) noexcept;

  /// How much the innermost point of an edge matters: infinite on cycles and between them. The edge
  /// is part of at(t), or some of it, if and only if this is >= t.
  double of_edge(std::uint32_t edge) const;
  /// What matters at least `threshold`, by increasing edge. O(n).
  std::vector<PathPiece> parts(double threshold) const;
  /// The same as an axis: nodes and edges in their order, all sites, the kinds of nodes anew. O(n).
  MedialAxis at(double threshold) const;
  /// Of at(threshold).
  std::uint64_t branches_at(double threshold) const;
  /// How many edges of at(threshold) are cut in their inside. O(n).
  std::uint64_t cuts_at(double threshold) const;
  /// The lowest threshold that keeps at most so many branches, or else the fewest. O(n log n).
  double threshold_of(std::uint64_t branches) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Prunes an axis. The homotopy type stays: connected parts and cycles, whatever the threshold; the
/// result of a larger threshold is a subset of a smaller one's. Errors: invalid_option (a threshold
/// that is negative or no number, or both a threshold and a number of branches).
Result<MedialAxis> prune(const MedialAxis& axis, const PruneOptions& options = {},
                         PruneReport* report = nullptr);

}  // namespace medial

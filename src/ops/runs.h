#pragma once

// Divides a branch into runs: first pieces on which the derivatives keep their signs, then longer
// runs of one class. See FeatureOptions in medial/features.h.

#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "medial/centreline.h"
#include "medial/features.h"
#include "medial/query.h"

namespace medial::ops {

/// Means of f, f u, f u^2 and f^2 along a run, with u from 0 to 1. They do not contain powers of
/// the length, which would overflow.
struct Moments {
  double zero = 0, first = 0, second = 0, square = 0;
};

/// A part of a branch with sums along it.
struct Run {
  EdgePlace from, to;
  double length = 0;
  Moments radius;
  Moments direction;            ///< of the angle from the tangent at the start
  double direction_change = 0;  ///< that angle at the end
  double bending = 0;           ///< integral of the curvature's size, breaks included
  Vec2 first_tangent, last_tangent;
  std::uint32_t first_piece = 0;  ///< of the pieces that the branch was cut into at first
  std::uint32_t piece_count = 1;
  Primitive primitive = Primitive::worm;
  Variation variation = Variation::straight;

  double mean_radius() const { return radius.zero; }
};

/// The quadratic least-squares fit to f on [0, 1]: its slope at the middle, its second derivative,
/// and its root mean square error.
struct Fit {
  double slope = 0;
  double bend = 0;
  double residual = 0;
};
Fit fit(const Moments& moments);

/// Classifies a run by its fits.
void classify(Run& run, const FeatureOptions& options);

/// The union of two consecutive runs, not classified.
Run joined(const Run& a, const Run& b);

/// Cuts branches into runs. Use one object for many branches, which saves allocations.
class RunCutter {
 public:
  RunCutter(const MedialAxis& axis, const FeatureOptions& options)
      : axis_(axis), options_(options) {}

  /// The runs along `steps`, in that direction. A `cyclic` branch may be joined across its start;
  /// its first run is then the longest one. Valid until the next call; empty without length.
  /// O(n log n).
  std::span<const Run> cut(std::span<const Step> steps, bool cyclic);

  /// Totals of the last call, over all pieces before merging.
  double length() const { return length_; }
  double radius_integral() const { return radius_integral_; }
  double smallest_radius() const { return smallest_; }
  double turning() const { return turning_; }
  double bending() const { return bending_; }

 private:
  void add_pieces(const Step& step);
  void link(bool cyclic);
  void absorb_next(std::uint32_t i, const Run& both);
  template <class Judge>
  void agglomerate(bool cyclic, const Judge& judge);
  void join_fitting(bool cyclic);
  void merge_short(bool cyclic);
  void join_equal(bool cyclic);
  void split_level();
  void compact();
  double relative_length(std::uint32_t i) const;

  struct Entry {
    double key;
    std::uint32_t run;
    std::uint32_t version;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : run > other.run;
    }
  };

  const MedialAxis& axis_;
  FeatureOptions options_;
  std::vector<Run> runs_;
  std::vector<Run> pieces_;  ///< of samples, before merging
  std::vector<std::uint32_t> next_, previous_, version_;
  std::priority_queue<Entry> heap_;
  std::vector<double> cuts_;
  double length_ = 0, radius_integral_ = 0, smallest_ = 0, turning_ = 0, bending_ = 0;
};

}  // namespace medial::ops

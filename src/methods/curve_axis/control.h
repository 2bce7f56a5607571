#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "methods/curve_axis/curve_axis.h"
#include "methods/curve_axis/generate.h"

namespace medial::curve_axis {

/// A scanned part of the boundary, from the left foot of its last axis point to the right foot, and
/// its axis: a branch from a tip of the boundary, or from a junction of two older segments, which
/// become its children.
struct Segment {
  std::vector<AxisPoint> branch;  ///< the first point is that of the tip or the junction
  int first_child = -1;           ///< of a junction: the child that is first along the boundary
  int second_child = -1;
  double middle = 0;  ///< of a junction: the foot that its children share
  int previous = -1;  ///< neighbours along the boundary, among the segments in use
  int next = -1;
  bool from_bridge = false;  ///< its first disk is certain
};

class Control;

/// A rule of the control process that is about to be applied; for pictures.
struct Decision {
  enum class Rule { larger, smaller, junction, retreat, outside_box, end };
  Rule rule;
  int active;          ///< the segment that grows
  AxisPoint point;     ///< its next point; of a junction: the first point of the third branch
  int neighbour = -1;  ///< the older segment of a conflict
};
using Observer = std::function<void(const Control&, const Decision&)>;

/// Section 5.2: decides where generations start, which branch wins a conflict, and when the axis is
/// complete.
class Control {
 public:
  Control(const Boundary& boundary, const method::CurveAxis& options, double step,
          Observer observer = {}, const std::atomic<bool>* cancel = nullptr);

  /// Scans the whole boundary. Requires a tip. Errors: cancelled, too_large, unsupported.
  Status run();

  const std::vector<Segment>& segments() const { return segments_; }
  /// The segments in use, ordered along the boundary.
  std::vector<int> in_use() const;
  /// After run(): the last segments of the axis, two if branches met head-on.
  const std::vector<int>& roots() const { return roots_; }
  /// The tip in which the last branch ends; none if branches met head-on.
  const std::optional<AxisPoint>& last_tip() const { return last_tip_; }
  const CurveAxisRules& rules() const { return rules_; }

 private:
  enum class Stop { conflict, retreat, outside, exhausted, complete };
  /// A foot of the active segment on a part of the boundary that a neighbour has scanned.
  struct Conflict {
    int neighbour = -1;
    bool on_right = false;
    double foot = 0;   ///< the neighbour's foot, in the period of the active segment
    AxisPoint active;  ///< the point of the active branch with that foot
  };

  bool is_exhausted() const;
  bool is_scanned(double u) const;
  int start(const Tip& tip);
  /// Generates axis points until a rule stops the branch, or the branch of a junction that
  /// continues it.
  Stop grow(int segment);
  bool is_in_box(Vec2 p) const;
  /// Resolves conflicts of the step from `here` to `there`, by the radii at one boundary point: the
  /// older branch retreats (Fig 5b), growth stops (Fig 5a), or `segment` becomes the segment of a
  /// junction (Fig 6).
  std::optional<Stop> resolve_conflicts(int& segment, const AxisPoint& here,
                                        const AxisPoint& there);
  /// Whether two branches have met head-on.
  bool is_same_disk(const AxisPoint& there, const AxisPoint& back) const;
  /// The junction at a contact where the radii become equal within the step.
  std::optional<Generator::Junction> junction_at(const Conflict& contact, const AxisPoint& here,
                                                 const AxisPoint& there) const;
  std::optional<Conflict> first_contact(int segment, const AxisPoint& from,
                                        const AxisPoint& to) const;
  /// The beginning of the boundary scanned from `begin` to `end`, relative to u: ahead of it, or
  /// behind it if u is in between.
  double first_foot(double u, double begin, double end) const;
  int join(int segment, const Conflict& contact, const Generator::Junction& at);
  /// Whether a segment consists only of the point of a tip.
  bool is_tip(int segment) const;
  bool is_bridge(int segment) const { return is_tip(segment) && at(segment).from_bridge; }
  /// Whether the only other segment is the last tip (Fig 8), or one step of its branch.
  bool is_last_tip(int tip, int segment) const;
  /// Joins a branch that cannot continue with a neighbour that is only a tip: the junction is on
  /// the tip's first step, which is longer than others. Returns the joined segment, or -1.
  int join_tip(int segment, const AxisPoint& here);
  void shrink(int segment);
  void tell(const Decision& decision) const {
    if (observer_) observer_(*this, decision);
  }
  void unlink(int segment);
  void replace(int segment, int first, int last);
  bool steps_over_twist(const AxisPoint& from, const AxisPoint& to) const;
  /// Whether a tip's circle is smaller than a disk, so that the tip's branch begins before that
  /// disk.
  bool is_sharper(const Tip& tip, double radius) const;
  bool end_in_tip(int segment, const AxisPoint& from);

  const AxisPoint& last(int segment) const {
    return segments_[static_cast<std::size_t>(segment)].branch.back();
  }
  Segment& at(int segment) { return segments_[static_cast<std::size_t>(segment)]; }
  const Segment& at(int segment) const { return segments_[static_cast<std::size_t>(segment)]; }

  const Boundary& boundary_;
  const method::CurveAxis& options_;
  const std::atomic<bool>* cancel_;
  Observer observer_;
  Generator generator_;
  double step_;
  std::size_t points_ = 0;
  std::vector<Segment> segments_;
  int any_ = -1;  ///< one of the segments in use
  std::vector<int> roots_;
  std::optional<AxisPoint> last_tip_;
  CurveAxisRules rules_;
};

}  // namespace medial::curve_axis

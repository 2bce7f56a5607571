#include "methods/curve_axis/control.h"

#include <algorithm>
#include <cmath>

namespace medial::curve_axis {
namespace {

/// Disks are equal if their centres are closer than this share of the size: points are zeros of
/// (14) up to rounding, so distinct points are a step apart.
constexpr double same_disk = 1e-8;
/// The largest distance of a junction from the points on both sides of it, in steps.
constexpr double junction_reach = 4;
/// Parameters are equal if they differ by less.
constexpr double same_parameter = 1e-7;
/// The largest number of points that all generations together may find: some 200 bytes each.
constexpr std::size_t most_points = std::size_t{1} << 21;
/// The largest number of evaluations of the boundary, in total and in addition for each of its
/// pieces: some seconds. A boundary of 300 maxima takes a tenth of that.
constexpr double most_evaluations = 2e7, most_evaluations_a_piece = 2e3;
/// How often generations are resumed before the rest of the boundary is given up.
constexpr int most_resumptions = 16;

double between(double a, double b, double share) { return a + share * (b - a); }

}  // namespace

Control::Control(const Boundary& boundary, const method::CurveAxis& options, double step,
                 Observer observer, const std::atomic<bool>* cancel)
    : boundary_(boundary),
      options_(options),
      cancel_(cancel),
      observer_(std::move(observer)),
      generator_(boundary, step),
      step_(step) {
  rules_.maxima = boundary.tips().size();
}

Status Control::run() {
  const std::vector<Tip>& tips = boundary_.tips();
  const std::size_t count = tips.size();
  const auto cancelled = [&] { return cancel_ != nullptr && cancel_->load(); };
  // Branches do not step over a bridge.
  std::vector<int> bridges(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    if (tips[i].kind == Tip::Kind::bridge) bridges[i] = start(tips[i]);
  // Clockwise, as in the paper.
  for (std::size_t i = 0; i < count; ++i) {
    if (cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
    const std::size_t which = (options_.first_maximum % count + count - i) % count;
    int segment = bridges[which];
    if (segment < 0 ? is_scanned(tips[which].u) : at(segment).next < 0) {
      ++rules_.skipped;
      continue;
    }
    if (segment < 0) segment = start(tips[which]);
    if (grow(segment) == Stop::complete) return success();
  }
  // A branch that stopped at another one, which was then taken back, may continue now.
  for (int round = 0; round < most_resumptions; ++round) {
    for (const int segment : in_use()) {
      if (cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
      if (at(segment).next < 0) continue;  // merged or abandoned meanwhile
      ++rules_.resumed;
      if (grow(segment) == Stop::complete) return success();
    }
    for (const Tip& tip : tips)
      if (!is_scanned(tip.u) && grow(start(tip)) == Stop::complete) return success();
  }
  if (is_exhausted())
    return Error{ErrorCode::too_large,
                 "the boundary is too uneven for the method curve-axis: after a few seconds of "
                 "work there is no axis; fit it less closely, or take longer steps",
                 {}};
  if (points_ > most_points)
    return Error{ErrorCode::too_large,
                 "the axis has more points than fit into memory: take longer steps",
                 {}};
  Place place;
  if (any_ >= 0) place.point = last(any_).right.point;
  return Error{ErrorCode::unsupported,
               "curve-axis goes astray here: use the method disks or a smoother boundary", place};
}

std::vector<int> Control::in_use() const {
  std::vector<int> all;
  if (any_ < 0) return all;
  int segment = any_;
  do {
    all.push_back(segment);
    segment = at(segment).next;
  } while (segment != any_);
  return all;
}

bool Control::is_exhausted() const {
  return static_cast<double>(boundary_.evaluations()) >
         most_evaluations + most_evaluations_a_piece * boundary_.period();
}

bool Control::is_scanned(double u) const {
  if (any_ < 0) return false;
  int segment = any_;
  do {
    const AxisPoint& end = last(segment);
    if (boundary_.above(u, end.left.u) <= end.right.u) return true;
    segment = at(segment).next;
  } while (segment != any_);
  return false;
}

int Control::start(const Tip& tip) {
  const int created = static_cast<int>(segments_.size());
  segments_.push_back(
      {{generator_.at(tip)}, -1, -1, 0, created, created, tip.kind == Tip::Kind::bridge});
  if (any_ < 0) {
    any_ = created;
    return created;
  }
  // Insert before the next segment.
  int next = any_, segment = any_;
  do {
    if (boundary_.above(last(segment).left.u, tip.u) < boundary_.above(last(next).left.u, tip.u))
      next = segment;
    segment = at(segment).next;
  } while (segment != any_);
  const int previous = at(next).previous;
  at(created).previous = previous;
  at(created).next = next;
  at(previous).next = created;
  at(next).previous = created;
  return created;
}

Control::Stop Control::grow(int segment) {
  while (true) {
    if (++points_ > most_points || is_exhausted()) return Stop::exhausted;
    const AxisPoint here = last(segment);
    const std::optional<AxisPoint> there = generator_.next(here);
    // Feet that meet do so in the tip; next to it, (14) may also converge to its trivial zero,
    // where one foot is on the other.
    const bool ends =
        !there || there->right.u >= there->left.u + boundary_.period() - same_parameter;
    const bool alone = at(segment).next == segment || is_last_tip(at(segment).next, segment);
    if (ends && alone && end_in_tip(segment, here)) return Stop::complete;
    // (10) is also violated if a foot steps over a maximum whose circle is smaller than the disk.
    if (ends || steps_over_twist(here, *there)) {
      if (const int joined = join_tip(segment, here); joined >= 0) {
        segment = joined;
        continue;
      }
      ++rules_.retreats;
      tell({Decision::Rule::retreat, segment, there.value_or(here), -1});
      return Stop::retreat;
    }
    if (!is_in_box(there->disk.center)) {
      ++rules_.outside_box;
      tell({Decision::Rule::outside_box, segment, *there, -1});
      return Stop::outside;
    }
    const int before = segment;
    if (const std::optional<Stop> stop = resolve_conflicts(segment, here, *there)) return *stop;
    if (segment == before) at(segment).branch.push_back(*there);
  }
}

bool Control::is_in_box(Vec2 p) const {
  return p.x >= boundary_.low().x && p.x <= boundary_.high().x && p.y >= boundary_.low().y &&
         p.y <= boundary_.high().y;
}

std::optional<Control::Stop> Control::resolve_conflicts(int& segment, const AxisPoint& here,
                                                        const AxisPoint& there) {
  while (const std::optional<Conflict> contact = first_contact(segment, here, there)) {
    const AxisPoint& old = last(contact->neighbour);
    const AxisPoint& active = contact->active;
    const bool only_two = at(at(segment).next).next == segment;
    if (only_two && is_same_disk(active, old)) {
      ++rules_.meetings;
      at(segment).branch.push_back(active);
      roots_ = {segment, contact->neighbour};
      return Stop::complete;
    }
    if (active.disk.radius < old.disk.radius && !is_bridge(contact->neighbour)) {
      ++rules_.smaller;
      tell({Decision::Rule::smaller, segment, active, contact->neighbour});
      shrink(contact->neighbour);
      continue;
    }
    const auto junction = junction_at(*contact, here, there);
    if (!junction) {
      ++rules_.larger;
      tell({Decision::Rule::larger, segment, active, contact->neighbour});
      return Stop::conflict;
    }
    ++rules_.junctions;
    if (observer_) {
      AxisPoint third =
          generator_.point_of(boundary_.at(junction->left), boundary_.at(junction->right));
      third.disk = junction->disk;
      tell({Decision::Rule::junction, segment, third, contact->neighbour});
    }
    segment = join(segment, *contact, *junction);
    return std::nullopt;
  }
  return std::nullopt;
}

bool Control::is_same_disk(const AxisPoint& there, const AxisPoint& back) const {
  // Disks of symmetric shapes touch more than two points, so the branches may come from other
  // sides.
  const double size = boundary_.size(), feet = std::sqrt(same_disk);
  return distance(there.disk.center, back.disk.center) <= same_disk * size &&
         distance(there.left.point, back.right.point) <= feet * size &&
         distance(there.right.point, back.left.point) <= feet * size;
}

std::optional<Generator::Junction> Control::junction_at(const Conflict& contact,
                                                        const AxisPoint& here,
                                                        const AxisPoint& there) const {
  const AxisPoint& old = last(contact.neighbour);
  const AxisPoint& active = contact.active;
  // In a tip both feet coincide; the next point of the branch shows how they separate.
  const bool is_tip = old.left.u == old.right.u;
  const AxisPoint outer = is_tip ? generator_.next(old).value_or(old) : old;
  const double left = contact.on_right
                          ? active.left.u
                          : boundary_.above(outer.left.u, contact.foot - boundary_.period());
  const double right =
      contact.on_right ? boundary_.above(outer.right.u, contact.foot) : active.right.u;
  const double shift = contact.foot - (contact.on_right ? old.left.u : old.right.u);
  const double middle = (contact.on_right ? outer.left.u : outer.right.u) + shift;
  auto junction = generator_.junction(left, middle, right);
  // The first point after a tip may be more than a step away.
  const auto reach = [&](const AxisPoint& last_one, const AxisPoint& next_one) {
    return std::max(junction_reach * step_,
                    2 * distance(last_one.disk.center, next_one.disk.center));
  };
  // The junction must be within a few steps of the last points of both branches, and be reached
  // from before it.
  const bool here_it_is = junction && junction->disk.radius > 0 &&
                          junction->right < junction->left + boundary_.period() &&
                          junction->left < junction->middle && junction->middle < junction->right &&
                          distance(junction->disk.center, here.disk.center) <= reach(here, there) &&
                          distance(junction->disk.center, old.disk.center) <= reach(old, outer);
  if (!here_it_is) return std::nullopt;
  return junction;
}

double Control::first_foot(double u, double begin, double end) const {
  // A junction may be a little beyond the place where one of its branches stopped.
  const double inside = boundary_.above(u, begin);
  return inside <= end ? u - (inside - begin) : boundary_.above(begin, u);
}

std::optional<Control::Conflict> Control::first_contact(int segment, const AxisPoint& from,
                                                        const AxisPoint& to) const {
  if (at(segment).next == segment) return std::nullopt;
  std::optional<Conflict> first;
  double first_share = 2;
  {
    const int neighbour = at(segment).next;
    const double foot = first_foot(from.right.u, last(neighbour).left.u, last(neighbour).right.u);
    const double share = std::max(-1.0, (foot - from.right.u) / (to.right.u - from.right.u));
    if (share <= 1) {
      const auto active = generator_.with_right(between(from.left.u, to.left.u, share), foot);
      first = Conflict{neighbour, true, foot, active.value_or(to)};
      first_share = share;
    }
  }
  const int neighbour = at(segment).previous;
  const double foot = -first_foot(-from.left.u, -last(neighbour).right.u, -last(neighbour).left.u);
  const double share = std::max(-1.0, (from.left.u - foot) / (from.left.u - to.left.u));
  if (share <= 1 && share < first_share) {
    const auto active = generator_.with_left(foot, between(from.right.u, to.right.u, share));
    first = Conflict{neighbour, false, foot, active.value_or(to)};
  }
  return first;
}

int Control::join(int segment, const Conflict& contact, const Generator::Junction& junction) {
  // Points of both branches beyond the junction are not part of the axis.
  const auto trim = [&](int branch, bool shares_right) {
    std::vector<AxisPoint>& points = at(branch).branch;
    const double n = boundary_.period();
    const auto is_beyond = [&](const AxisPoint& p) {
      const double u = shares_right ? p.right.u : p.left.u;
      const double apart = u - junction.middle - n * std::round((u - junction.middle) / n);
      return shares_right ? apart >= 0 : apart <= 0;
    };
    while (points.size() > 1 && is_beyond(points.back())) points.pop_back();
  };
  trim(segment, contact.on_right);
  trim(contact.neighbour, !contact.on_right);
  const int created = static_cast<int>(segments_.size());
  AxisPoint point = generator_.point_of(boundary_.at(junction.left), boundary_.at(junction.right));
  point.disk = junction.disk;
  const int first = contact.on_right ? segment : contact.neighbour;
  const int second = contact.on_right ? contact.neighbour : segment;
  const int before = at(first).previous, after = at(second).next;
  segments_.push_back({{point}, first, second, junction.middle, before, after});
  if (before == second) {  // these two were the only ones
    at(created).previous = at(created).next = created;
  } else {
    at(before).next = created;
    at(after).previous = created;
  }
  for (const int child : {first, second}) at(child).previous = at(child).next = -1;
  any_ = created;
  return created;
}

bool Control::is_last_tip(int tip, int segment) const {
  // In needles, a branch may get no further than a fraction of a step.
  return at(tip).next == segment && at(segment).next == tip && at(tip).first_child < 0 &&
         !at(tip).from_bridge &&
         distance(at(tip).branch.front().disk.center, last(tip).disk.center) <= step_;
}

bool Control::is_tip(int segment) const {
  return at(segment).branch.size() == 1 && at(segment).first_child < 0;
}

int Control::join_tip(int segment, const AxisPoint& here) {
  for (const bool on_right : {true, false}) {
    const int neighbour = on_right ? at(segment).next : at(segment).previous;
    if (neighbour == segment || !is_tip(neighbour)) continue;
    const AxisPoint& tip = last(neighbour);
    const std::optional<AxisPoint> first = generator_.next(tip);
    if (!first) continue;
    // The feet of the tip's first point, relative to the feet of this branch.
    const double tip_u = on_right ? boundary_.above(tip.left.u, here.right.u)
                                  : -boundary_.above(-tip.right.u, -here.left.u);
    const double shift = tip_u - (on_right ? tip.left.u : tip.right.u);
    const double near = (on_right ? first->left.u : first->right.u) + shift;
    const double far = (on_right ? first->right.u : first->left.u) + shift;
    const double shared = 0.5 * (near + (on_right ? here.right.u : here.left.u));
    const auto junction = on_right ? generator_.junction(here.left.u, shared, far)
                                   : generator_.junction(far, shared, here.right.u);
    if (!junction || !(junction->disk.radius > 0)) continue;
    const bool in_order = junction->left < junction->middle && junction->middle < junction->right &&
                          junction->right < junction->left + boundary_.period() &&
                          (on_right ? junction->middle < tip_u && tip_u < junction->right
                                    : junction->left < tip_u && tip_u < junction->middle);
    // This branch may have passed the junction by about a step: join() takes that back.
    const double reach =
        std::max(junction_reach * step_, 2 * distance(tip.disk.center, first->disk.center));
    if (!in_order || distance(junction->disk.center, here.disk.center) > junction_reach * step_ ||
        distance(junction->disk.center, tip.disk.center) > reach ||
        junction->disk.radius < tip.disk.radius)
      continue;
    // The way from the tip to the junction, in steps.
    const double left = (on_right ? junction->middle : junction->left) - shift;
    const double right = (on_right ? junction->right : junction->middle) - shift;
    const double way = distance(junction->disk.center, tip.disk.center);
    const int steps = static_cast<int>(std::ceil(way / step_));
    const AxisPoint origin = tip;  // the branch grows
    for (int i = 1; i < steps; ++i) {
      // The feet separate like the square root of the way.
      const double share = std::sqrt(static_cast<double>(i) / steps);
      const auto point = generator_.stabilised(between(origin.left.u, left, share),
                                               between(origin.right.u, right, share));
      const AxisPoint& before = last(neighbour);
      if (point && point->left.u < before.left.u && point->right.u > before.right.u &&
          point->left.u > left && point->right.u < right)
        at(neighbour).branch.push_back(*point);
    }
    ++rules_.junctions;
    return join(segment, {neighbour, on_right, junction->middle, here}, *junction);
  }
  return -1;
}

void Control::shrink(int segment) {
  Segment& old = at(segment);
  old.branch.pop_back();
  if (!old.branch.empty()) return;
  if (old.first_child < 0) {
    ++rules_.abandoned;
    unlink(segment);
  } else {
    ++rules_.dissolved;
    replace(segment, old.first_child, old.second_child);
  }
}

void Control::unlink(int segment) {
  const int before = at(segment).previous, after = at(segment).next;
  at(before).next = after;
  at(after).previous = before;
  if (any_ == segment) any_ = after;
  at(segment).previous = at(segment).next = -1;
}

void Control::replace(int segment, int first, int second) {
  const int before = at(segment).previous, after = at(segment).next;
  at(first).previous = before;
  at(first).next = second;
  at(second).previous = first;
  at(second).next = after;
  at(before).next = first;
  at(after).previous = second;
  if (any_ == segment) any_ = first;
  at(segment).previous = at(segment).next = -1;
}

bool Control::steps_over_twist(const AxisPoint& from, const AxisPoint& to) const {
  const double radius = std::min(from.disk.radius, to.disk.radius);
  const std::vector<Tip>& tips = boundary_.tips();
  const auto twisted = [&](double low, double high) {
    // The first tip after `low`, and those that follow.
    const double n = boundary_.period(), start = boundary_.above(low, 0);
    auto next = std::lower_bound(tips.begin(), tips.end(), start,
                                 [](const Tip& tip, double u) { return tip.u < u; });
    for (std::size_t i = 0; i < tips.size(); ++i, ++next) {
      if (next == tips.end()) next = tips.begin();
      double way = next->u - start;
      if (way < 0) way += n;
      if (way >= high - low) return false;
      if (way > 0 && is_sharper(*next, radius) && !is_scanned(next->u)) return true;
    }
    return false;
  };
  // A foot that stops in a tip, where the curvature jumps, has reached it, and continues from
  // there.
  return twisted(to.left.u - same_parameter, from.left.u - same_parameter) ||
         twisted(from.right.u + same_parameter, to.right.u + same_parameter);
}

bool Control::is_sharper(const Tip& tip, double radius) const {
  if (tip.kind == Tip::Kind::bridge) return false;
  return tip.kind == Tip::Kind::corner || boundary_.sharper_at(tip.u).turn * radius >= 1;
}

bool Control::end_in_tip(int segment, const AxisPoint& from) {
  // The rest of the boundary must be along the last disk: otherwise it has an axis of its own.
  constexpr int samples = 32;
  const double rest = from.left.u + boundary_.period() - from.right.u;
  for (int i = 1; i < samples; ++i) {
    const Vec2 p = boundary_.at(from.right.u + rest * i / samples).point;
    if (std::abs(distance(p, from.disk.center) - from.disk.radius) > junction_reach * step_)
      return false;
  }
  // Two tips, with circles smaller than the disk, are the ends of two branches.
  std::vector<Tip> tips;
  for (const Tip& tip : boundary_.tips()) {
    const double u = boundary_.above(tip.u, from.right.u);
    if (u <= from.right.u || u >= from.left.u + boundary_.period()) continue;
    if (is_sharper(tip, from.disk.radius)) tips.push_back(tip);
  }
  if (tips.size() > 1) return false;
  for (const Tip& one : tips) {
    const AxisPoint tip = generator_.at(one);
    if (distance(tip.disk.center, from.disk.center) > junction_reach * step_) continue;
    ++rules_.ends;
    tell({Decision::Rule::end, segment, tip, -1});
    last_tip_ = tip;
    roots_ = {segment};
    return true;
  }
  return false;
}

}  // namespace medial::curve_axis

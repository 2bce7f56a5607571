// Shaked and Bruckstein (1996): Figs. 1 to 9 of "The Curve Axis", drawn again. The states of the
// control process are its own, just before a rule is carried out.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "medial/medial.h"
#include "methods/curve_axis/control.h"
#include "papers/experiment.h"
#include "papers/figure.h"
#include "papers/shaked_bruckstein_1996/experiment.h"
#include "papers/shaked_bruckstein_1996/spline.h"

namespace medial::papers {

namespace {

using curve_axis::AxisPoint;
using curve_axis::Boundary;
using curve_axis::BoundaryPoint;
using curve_axis::Control;
using curve_axis::Decision;
using curve_axis::Generator;
using curve_axis::Segment;
using curve_axis::Tip;
using Rule = Decision::Rule;

Contour spline_through(std::vector<Vec2> corners) {
  return papers::spline_through(std::move(corners), 1e3);
}

/// A body with a head, four legs and a tail.
Contour animal() {
  return spline_through({{0, 4},      {0.3, 2},   {-0.6, 0.2}, {0.6, -0.3}, {1.7, 1.6},
                         {3.5, 2.2},  {5.5, 2},   {7, 1.4},    {7.6, -0.4}, {8.8, -0.2},
                         {8.7, 1.8},  {9.3, 3.6}, {11, 2.4},   {11.8, 3},   {10.6, 5},
                         {8.6, 5.8},  {6, 5.6},   {3.4, 5.4},  {2, 6.4},    {1.2, 8.4},
                         {-0.8, 9.2}, {-2.6, 8},  {-1.8, 7.2}, {-0.6, 6.6}});
}

/// A bent drop: one pointed end, one blunt.
Contour drop() {
  return spline_through({{0, 0},
                         {2.2, -0.9},
                         {5, -1.9},
                         {8, -1.8},
                         {10, 0.4},
                         {9.6, 3.4},
                         {7.2, 4.6},
                         {4.8, 3.6},
                         {2.6, 1.5}});
}

/// A bent band with bulges, whose curvature has maxima that are no leaves.
Contour bean() {
  return spline_through({{0, 0},
                         {2.4, -1.1},
                         {5, -1.5},
                         {7.6, -1},
                         {9.6, 1},
                         {9.9, 3.6},
                         {8.6, 5},
                         {6.9, 4.2},
                         {6.2, 2.4},
                         {4.6, 1.7},
                         {2.8, 2.2},
                         {1.2, 3},
                         {-0.6, 2.4},
                         {-1.1, 1.1}});
}

/// A star of smooth waves: `seed` sets their phases.
Contour waves(int seed) {
  std::vector<Vec2> corners;
  constexpr int count = 26;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    double radius = 1;
    for (int k = 2; k <= 7; ++k) radius += 0.42 / k * std::cos(k * angle + 1.7 * k * k + seed * k);
    corners.push_back({4 * radius * std::cos(angle), 4 * radius * std::sin(angle)});
  }
  return spline_through(corners);
}

/// A curve with its boundary, and the control process on it.
struct Stage {
  explicit Stage(const Contour& contour)
      : boundary(curve_axis::normalized(contour)), step(options.step * boundary.size()) {}

  Box frame(double room) const {
    return {boundary.low() - Vec2{room, room}, boundary.high() + Vec2{room, room}};
  }
  /// Runs it, and calls `draw` before the decision of that rule whose active branch is longest.
  template <class Draw>
  bool at(Rule rule, const Draw& draw) const {
    std::size_t longest = 0;
    const auto run = [&](const curve_axis::Observer& observer) {
      Control control(boundary, options, step, observer);
      return control.run().ok();
    };
    const auto length_of = [](const Control& control, const Decision& decision) {
      const auto points = [&](int i) {
        return i < 0 ? 0 : control.segments()[static_cast<std::size_t>(i)].branch.size();
      };
      return points(decision.active) + points(decision.neighbour);
    };
    run([&](const Control& control, const Decision& decision) {
      if (decision.rule == rule) longest = std::max(longest, length_of(control, decision));
    });
    bool drawn = false;
    run([&](const Control& control, const Decision& decision) {
      if (drawn || decision.rule != rule || length_of(control, decision) != longest) return;
      drawn = true;
      draw(control, decision);
    });
    return drawn;
  }

  method::CurveAxis options{.step = 2e-3};
  Boundary boundary;
  double step;
};

double sharpest(const Boundary& boundary) {
  return std::max_element(boundary.tips().begin(), boundary.tips().end(),
                          [&](const Tip& a, const Tip& b) {
                            return boundary.at(a.u).turn < boundary.at(b.u).turn;
                          })
      ->u;
}

/// `density`: points on a piece.
std::vector<Vec2> part_of(const Boundary& boundary, double from, double to, double density = 24) {
  std::vector<Vec2> line;
  const int count = std::max(2, static_cast<int>(std::ceil(density * (to - from))));
  for (int i = 0; i <= count; ++i)
    line.push_back(boundary.at(from + (to - from) * i / count).point);
  return line;
}

void draw_boundary(Figure& figure, const Boundary& boundary) {
  figure.line(part_of(boundary, 0, boundary.period()));
}

std::vector<Vec2> centres(const std::vector<AxisPoint>& branch) {
  std::vector<Vec2> line;
  for (const AxisPoint& point : branch) line.push_back(point.disk.center);
  return line;
}

/// A segment's branch and those behind it.
void draw_tree(Figure& figure, const Control& control, int segment, std::optional<Vec2> end = {}) {
  const Segment& root = control.segments()[static_cast<std::size_t>(segment)];
  std::vector<Vec2> line = centres(root.branch);
  if (end) line.push_back(*end);
  figure.line(line);
  for (const int child : {root.first_child, root.second_child})
    if (child >= 0) draw_tree(figure, control, child, root.branch.front().disk.center);
}

void draw_scanned(Figure& figure, const Boundary& boundary, const AxisPoint& last) {
  figure.line(part_of(boundary, last.left.u, boundary.above(last.right.u, last.left.u)));
}

const AxisPoint& last_of(const Control& control, int segment) {
  return control.segments()[static_cast<std::size_t>(segment)].branch.back();
}

void draw_disk(Figure& figure, const AxisPoint& point) {
  figure.circle(point.disk);
  figure.line({point.left.point, point.disk.center, point.right.point});
  for (const Vec2 p : {point.left.point, point.disk.center, point.right.point}) figure.dot(p);
}

/// Segments, scanned boundary and axis, of all in use; letters at their scanned boundary.
void draw_state(Figure& figure, const Stage& stage, const Control& control, bool letters) {
  figure.thin();
  draw_boundary(figure, stage.boundary);
  std::size_t which = 0;
  for (const int segment : control.in_use()) {
    const AxisPoint& last = last_of(control, segment);
    figure.color(which, 2.4);
    draw_scanned(figure, stage.boundary, last);
    figure.color(which, 1.2);
    draw_tree(figure, control, segment);
    if (letters) {
      const double middle = (last.left.u + stage.boundary.above(last.right.u, last.left.u)) / 2;
      const BoundaryPoint at = stage.boundary.at(middle);
      const std::string letter(1, static_cast<char>('A' + which));
      const Vec2 out = -at.normal();
      figure.label(at.point, letter.c_str(), 13 * out - Vec2{4, 5});
    }
    ++which;
  }
}

/// Fig. 1: two disks of an axis, the azimuth theta from the axis to the boundary.
Status azimuth(const std::filesystem::path& path) {
  const Stage stage(drop());
  const Generator generator(stage.boundary, stage.step);
  AxisPoint point = generator.at_maximum(sharpest(stage.boundary));
  std::vector<Vec2> line{point.disk.center}, left, right;
  std::vector<AxisPoint> points;
  while (const auto next = generator.next(point)) {
    point = *next;
    points.push_back(point);
    line.push_back(point.disk.center);
    left.push_back(point.left.point);
    right.push_back(point.right.point);
    if (points.size() > 220) break;
  }
  const std::size_t at = points.size() / 3, further = at + points.size() / 6;
  const AxisPoint &a = points[at], &b = points[further];
  const double r = std::max(a.disk.radius, b.disk.radius) * 1.5;
  const Vec2 middle = midpoint(a.disk.center, b.disk.center);
  Figure figure({middle - Vec2{r, r}, middle + Vec2{r, r}});
  figure.ink();
  figure.line(left);
  figure.line(right);
  figure.color(1, 1.8);
  figure.line(line);
  figure.thin();
  figure.circle(a.disk);
  figure.circle(b.disk);
  figure.ink();
  figure.line({a.left.point, a.disk.center, a.right.point});
  figure.line({b.left.point, b.disk.center});
  // The direction backwards, and the angle from it to the radius.
  figure.color(0, 1.2);
  const Vec2 back = a.disk.center - 0.9 * a.disk.radius * a.tangent;
  figure.dashed(std::array{a.disk.center, back});
  const Vec2 to_left = a.left.point - a.disk.center;
  const double from = std::atan2(-a.tangent.y, -a.tangent.x);
  const double theta = std::atan2(cross(-a.tangent, to_left), dot(-a.tangent, to_left));
  std::vector<Vec2> arc;
  for (int i = 0; i <= 24; ++i) {
    const double angle = from + theta * i / 24;
    arc.push_back(a.disk.center + 0.3 * a.disk.radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  figure.line(arc);
  figure.label(arc[12], "θ", {-12, -6});
  figure.ink();
  const auto name = [&](Vec2 p, const char* text, Vec2 offset) {
    figure.dot(p);
    figure.label(p, text, offset);
  };
  name(a.disk.center, "A(a)", {4, -16});
  name(b.disk.center, "A(a + Δa)", {4, -16});
  name(a.left.point, "L(a)", {-32, 8});
  name(b.left.point, "L(a + Δa)", {-64, 8});
  name(a.right.point, "R(a)", {-14, -18});
  return figure.write(path);
}

/// Fig. 2: the circle of curvature in a maximum, and the axis that begins in its centre.
Status beginning(const std::filesystem::path& path) {
  const Stage stage(drop());
  const Generator generator(stage.boundary, stage.step);
  const double u = sharpest(stage.boundary);
  const AxisPoint tip = generator.at_maximum(u);
  AxisPoint point = tip;
  std::vector<AxisPoint> points{point};
  for (int i = 0; i < 60; ++i) {
    const auto next = generator.next(point);
    if (!next) break;
    point = *next;
    points.push_back(point);
  }
  const double r = 2.6 * tip.disk.radius;
  const Vec2 middle = tip.disk.center + tip.disk.radius * tip.tangent;
  Figure figure({middle - Vec2{r, r}, middle + Vec2{r, r}});
  figure.ink();
  figure.color(1, 1.6);
  figure.line(part_of(stage.boundary, u - 2, u, 100));
  figure.color(2, 1.6);
  figure.line(part_of(stage.boundary, u, u + 2, 100));
  figure.thin();
  figure.circle(tip.disk);
  figure.color(0, 1.6);
  figure.line(centres(points));
  figure.ink();
  figure.line({tip.left.point, tip.disk.center});
  figure.dot(tip.left.point);
  figure.dot(tip.disk.center);
  figure.label(midpoint(tip.left.point, tip.disk.center), "1/K", {6, 0});
  figure.label(tip.disk.center, "R(0) = 1/K", {8, -14});
  figure.label(points[4].left.point, "L", {-16, 4});
  figure.label(points[4].right.point, "R", {-16, -12});
  return figure.write(path);
}

/// Figs. 3 and 6: what leads to a junction, and the third branch.
Status junction(const std::filesystem::path& path, bool with_boundary) {
  const Stage stage(animal());
  std::optional<Figure> figure;
  stage.at(Rule::junction, [&](const Control& control, const Decision& decision) {
    const Disk& disk = decision.point.disk;
    const double r = disk.radius * (with_boundary ? 2.4 : 1.9);
    figure.emplace(Box{disk.center - Vec2{r, r}, disk.center + Vec2{r, r}});
    figure->thin();
    draw_boundary(*figure, stage.boundary);
    figure->circle(disk);
    // The third branch, for some steps.
    const Generator generator(stage.boundary, stage.step);
    std::vector<AxisPoint> third{decision.point};
    while (third.size() < 60) {
      const auto next = generator.next(third.back());
      if (!next) break;
      third.push_back(*next);
    }
    std::size_t which = 0;
    for (const int segment : {decision.active, decision.neighbour}) {
      const AxisPoint& last = last_of(control, segment);
      if (with_boundary) {
        figure->color(which, 2.6);
        draw_scanned(*figure, stage.boundary, last);
      }
      figure->color(which, 1.8);
      draw_tree(*figure, control, segment, disk.center);
      figure->arrow_head(disk.center, last.tangent);
      figure->label(disk.center - 0.7 * disk.radius * last.tangent, which == 0 ? "2" : "1", {6, 4});
      ++which;
    }
    figure->color(2, 1.8);
    figure->line(centres(third));
    figure->arrow_head(third.back().disk.center, third.back().tangent);
    figure->label(third.back().disk.center, "3", {6, 4});
    figure->ink();
    figure->dot(disk.center);
    for (const BoundaryPoint& foot : {decision.point.left, decision.point.right}) {
      figure->dot(foot.point);
      figure->line({foot.point, disk.center});
    }
    // The middle foot is the one the two segments meet in.
    const AxisPoint& first = last_of(control, decision.active);
    const Vec2 shared = distance(first.left.point, decision.point.left.point) <
                                distance(first.right.point, decision.point.right.point)
                            ? first.right.point
                            : first.left.point;
    figure->line({shared, disk.center});
    figure->dot(shared);
  });
  if (!figure) return Error{ErrorCode::internal, "a figure's situation did not come up", {}};
  return figure->write(path);
}

/// Fig. 4: the whole shape at an intermediate stage, of those with three segments the one whose
/// least segment has come farthest.
Status intermediate(const std::filesystem::path& path) {
  const Stage stage(animal());
  const auto run = [&](const curve_axis::Observer& observer) {
    return Control(stage.boundary, stage.options, stage.step, observer).run();
  };
  const auto least_segment = [&](const Control& control) {
    const std::vector<int> all = control.in_use();
    double least = all.size() < 3 ? 0 : stage.boundary.period();
    for (const int segment : all) {
      const AxisPoint& last = last_of(control, segment);
      least = std::min(least, stage.boundary.above(last.right.u, last.left.u) - last.left.u);
    }
    return least;
  };
  double most = 0;
  Status done = run([&](const Control& control, const Decision&) {
    most = std::max(most, least_segment(control));
  });
  if (!done) return done;
  Figure figure(stage.frame(1));
  bool drawn = false;
  done = run([&](const Control& control, const Decision&) {
    if (drawn || least_segment(control) < most) return;
    drawn = true;
    draw_state(figure, stage, control, true);
  });
  return done ? figure.write(path) : done;
}

/// Figs. 5 and 7: a decision on one of the waves, the first one that it is called for on.
Status decision(const std::filesystem::path& path, Rule rule) {
  for (int seed = 0; seed < 200; ++seed) {
    const Stage stage(waves(seed));
    std::optional<Figure> figure;
    stage.at(rule, [&](const Control& control, const Decision& d) {
      const Segment& active = control.segments()[static_cast<std::size_t>(d.active)];
      const double largest = 0.35 * stage.boundary.size();
      if (active.branch.size() < 40) return;
      if (rule != Rule::outside_box &&
          (d.point.disk.radius > largest ||
           (d.neighbour >= 0 && last_of(control, d.neighbour).disk.radius > largest)))
        return;
      figure.emplace(stage.frame(rule == Rule::outside_box ? 1.5 : 1));
      figure->thin();
      draw_boundary(*figure, stage.boundary);
      std::size_t which = 0;
      for (const int segment : {d.active, d.neighbour}) {
        if (segment < 0) break;
        const AxisPoint& last = last_of(control, segment);
        figure->color(which, 2.4);
        draw_scanned(*figure, stage.boundary, last);
        figure->color(which, 1.2);
        draw_tree(*figure, control, segment);
        draw_disk(*figure, which == 0 ? d.point : last);
        ++which;
      }
      if (rule == Rule::outside_box) {
        figure->thin();
        const Vec2 low = stage.boundary.low(), high = stage.boundary.high();
        figure->dashed(std::array{low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}, low});
      }
    });
    if (figure) return figure->write(path);
  }
  return Error{ErrorCode::internal, "a figure's situation did not come up", {}};
}

/// Fig. 8: the last branch runs towards the last maximum.
Status ending(const std::filesystem::path& path) {
  // Of all maxima to start from, the one that leaves the longest branch for the end.
  Stage stage(animal());
  std::size_t longest = 0, best = 0;
  for (std::size_t i = 0; i < stage.boundary.tips().size(); ++i) {
    stage.options.first_maximum = i;
    stage.at(Rule::end, [&](const Control& control, const Decision& d) {
      const auto& branch = control.segments()[static_cast<std::size_t>(d.active)].branch;
      if (branch.size() > longest) best = i;
      longest = std::max(longest, branch.size());
    });
  }
  stage.options.first_maximum = best;
  Figure figure(stage.frame(1));
  const bool drawn = stage.at(Rule::end, [&](const Control& control, const Decision& d) {
    draw_state(figure, stage, control, false);
    const std::vector<AxisPoint>& branch =
        control.segments()[static_cast<std::size_t>(d.active)].branch;
    figure.color(1, 2);
    figure.line(centres(branch));
    const AxisPoint& middle = branch[branch.size() / 2];
    figure.arrow_head(middle.disk.center, middle.tangent);
    figure.label(middle.disk.center, "A", {4, 8});
    figure.ink();
    figure.dot(d.point.left.point);
    figure.dot(branch.front().disk.center);
  });
  if (!drawn) return Error{ErrorCode::internal, "a figure's situation did not come up", {}};
  return figure.write(path);
}

/// Fig. 9: an axis, and the boundary's maxima of curvature; open are those without a leaf.
Status result(const std::filesystem::path& path, const Contour& contour) {
  const Stage stage(contour);
  const auto axis = compute_curve_axis({&contour, 1});
  if (!axis) return axis.error();
  Figure figure(stage.frame(0.5));
  figure.ink();
  draw_boundary(figure, stage.boundary);
  figure.color(1, 1.6);
  for (const auto& branch : axis->branches) {
    std::vector<Vec2> line;
    for (const CurveAxisPoint& point : branch) line.push_back(point.disk.center);
    figure.line(line);
  }
  for (const Tip& place : stage.boundary.tips()) {
    const BoundaryPoint tip = stage.boundary.at(place.u);
    const Vec2 centre = tip.point + (1 / tip.turn) * tip.normal();
    bool has_leaf = false;
    for (const Node& node : axis->axis.nodes)
      has_leaf = has_leaf ||
                 (node.kind == NodeKind::leaf && distance(node.disk.center, centre) < stage.step);
    figure.pen(0.80, 0.20, 0.20, 1.2);
    if (has_leaf)
      figure.dot(tip.point);
    else
      figure.circle({tip.point, 0.008 * stage.boundary.size()});
  }
  return figure.write(path);
}

}  // namespace

Status draw_figures(const Request& request) {
  const auto at = [&](const char* name) { return request.to / name; };
  return in_order(
      [&] { return azimuth(at("fig1.svg")); }, [&] { return beginning(at("fig2.svg")); },
      [&] { return junction(at("fig3.svg"), false); }, [&] { return intermediate(at("fig4.svg")); },
      [&] { return decision(at("fig5a.svg"), Rule::larger); },
      [&] { return decision(at("fig5b.svg"), Rule::smaller); },
      [&] { return junction(at("fig6.svg"), true); },
      [&] { return decision(at("fig7a.svg"), Rule::retreat); },
      [&] { return decision(at("fig7b.svg"), Rule::outside_box); },
      [&] { return ending(at("fig8.svg")); }, [&] { return result(at("fig9a.svg"), animal()); },
      [&] { return result(at("fig9b.svg"), bean()); });
}

}  // namespace medial::papers

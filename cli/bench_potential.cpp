#include "cli/bench_potential.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/local_frame.h"
#include "cli/axis_distance.h"
#include "cli/figure.h"
#include "cli/terminal.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"
#include "methods/potential/successor.h"

namespace medial::cli {
namespace {

constexpr std::array orders = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 0.0};

Shape shape_of(std::vector<Vec2> points) {
  Ring ring;
  ring.points = std::move(points);
  return *build_shape(std::vector<Ring>{ring});
}

double size_of(const Shape& shape) {
  const Box box = bounding_box(shape);
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

std::string order_name(double order) {
  return order == 0 ? "adaptive" : fmt::format("n={:g}", order);
}

/// A band with teeth of noise on its long sides, `edges` edges in all.
Shape noisy_band(int teeth, double height) {
  std::vector<Vec2> points;
  const double step = 10.0 / teeth;
  std::uint32_t state = 7;
  const auto noise = [&] {
    state = state * 1664525U + 1013904223U;
    return height * (static_cast<double>(state >> 8U) / 16777216.0 - 0.5);
  };
  for (int i = 0; i <= teeth; ++i) points.push_back({i * step, -1 + noise()});
  for (int i = teeth; i >= 0; --i) points.push_back({i * step, 1 + noise()});
  return shape_of(points);
}

/// The sum of all turns along the edges between nodes of degree two, in degrees, over the length in
/// units of the size: how crooked an axis is.
double crookedness(const MedialAxis& axis, double size) {
  const Incidence incidence(axis);
  double turns = 0;
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i) {
    if (incidence.degree(i) != 2) continue;
    const auto edges = incidence.edges(i);
    const auto other = [&](std::uint32_t e) {
      const Edge& edge = axis.edges[e];
      return axis.nodes[edge.node[0] == i ? edge.node[1] : edge.node[0]].disk.center;
    };
    const Vec2 in = axis.nodes[i].disk.center - other(edges[0]);
    const Vec2 out = other(edges[1]) - axis.nodes[i].disk.center;
    turns += std::abs(std::atan2(cross(in, out), dot(in, out)));
  }
  return turns * 180 / std::numbers::pi / (total_length(axis) / size);
}

/// The adaptive order at each point of the rectangle's Newtonian skeleton but its corners, for the
/// paper's theta_min of 2.56 degrees.
std::vector<std::pair<Vec2, int>> orders_in_rectangle() {
  const Shape shape = potential_regions()[0].second;
  const LocalFrame frame = frame_of(bounding_box(shape));
  const auto regions = potential::regions_of(shape, frame, 0.01, 1e-3);
  const potential::Charges charges(regions[0].pieces);
  potential::SkeletonOptions tracing;
  tracing.step = 0.01 * regions[0].size;
  const auto skeleton = potential::trace_valleys(regions[0], charges, tracing);
  potential::Evaluator evaluator(charges);
  std::vector<std::pair<Vec2, int>> orders_there;
  for (const auto& point : skeleton.points) {
    if (point.radius == 0) continue;
    evaluator.place(point.place);
    orders_there.emplace_back(
        frame.to_input(point.place),
        potential::adaptive_order(evaluator, std::acos(0.999), potential::most_searched_order));
  }
  return orders_there;
}

double exponent_of(int order) { return 0.5 * (order + 2); }

std::string orders_along_rectangle() {
  std::vector<std::pair<double, int>> along;
  for (const auto& [p, order] : orders_in_rectangle())
    if (p.x <= 10 && p.y <= 5.001) along.emplace_back(p.x, order);
  std::sort(along.begin(), along.end());
  std::string text = "| x | N | p = (N + 2) / 2 |\n| ---: | ---: | ---: |\n";
  double next = 0;
  for (const auto& [x, order] : along) {
    if (x < next) continue;
    text += fmt::format("| {:.2f} | {} | {} |\n", x, order, exponent_of(order));
    next = x + 0.5;
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, Shape>> potential_regions() {
  return {{"rectangle", shape_of({{0, 0}, {20, 0}, {20, 10}, {0, 10}})},
          {"L", shape_of({{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}})},
          {"hand", shape_of({{0, 0},
                             {10, 0},
                             {12, 5},
                             {20, 4},
                             {20, 7},
                             {13, 9},
                             {19, 15},
                             {17, 17},
                             {11, 12},
                             {8, 20},
                             {5, 20},
                             {6, 12},
                             {-1, 15},
                             {-3, 12},
                             {3, 8}})}};
}

Status write_potential_figures(const std::string& directory) {
  const auto to = make_directory(directory);
  if (!to) return to.error();
  const Shape shape = potential_regions()[0].second;
  Figure figure(bounding_box(shape));
  figure.ink();
  figure.line(shape.points);
  figure.line({shape.points.back(), shape.points.front()});
  // As dense as the numbers can be read.
  constexpr double apart = 0.75, largest_shown = 9;
  std::vector<Vec2> shown = shape.points;
  for (const auto& [p, order] : orders_in_rectangle()) {
    if (std::any_of(shown.begin(), shown.end(),
                    [&, q = p](Vec2 other) { return distance(q, other) < apart; }))
      continue;
    shown.push_back(p);
    const double exponent = exponent_of(order);
    figure.mark(p, exponent > largest_shown ? "x" : fmt::format("{:g}", exponent).c_str());
  }
  return figure.write(*to / "potential-fig13.svg");
}

PotentialReport run_potential_experiments(const std::vector<std::pair<std::string, Shape>>& shapes,
                                          const std::function<void(const std::string&)>& progress) {
  PotentialReport report;
  std::string largest = "| shape | edges |", mean, rule = "\n| --- | ---: |";
  for (const double order : orders) {
    largest += fmt::format(" {} |", order_name(order));
    rule += " ---: |";
  }
  largest += fmt::format(" away from leaves | falls |{} ---: | --- |\n", rule);
  mean = largest;
  for (const auto& [name, shape] : shapes) {
    progress(name);
    const auto exact = compute(shape);
    if (!exact) continue;
    const double size = size_of(shape);
    largest += fmt::format("| {} | {} |", name, shape.points.size());
    mean += fmt::format("| {} | {} |", name, shape.points.size());
    double away = 0, before = 1;
    bool falls = true;
    for (const double order : orders) {
      Options options;
      options.method = Method::potential;
      options.threads = 1;
      options.potential.order = order;
      const auto axis = compute(shape, options);
      if (!axis) {
        largest += " - |";
        mean += " - |";
        report.passed = false;
        continue;
      }
      const AxisDistance distance = distance_between(*axis, *exact, 0.005 * size, 0.05 * size);
      largest += fmt::format(" {:.3f} |", 100 * distance.largest / size);
      mean += fmt::format(" {:.4f} |", 100 * distance.mean / size);
      if (order > 0) falls = falls && distance.mean / size <= before;
      before = distance.mean / size;
      away = distance.away / size;
    }
    largest += fmt::format(" {:.3f} | {} |\n", 100 * away, falls ? "yes" : "NO");
    mean += fmt::format(" {:.3f} | {} |\n", 100 * away, falls ? "yes" : "NO");
  }
  progress("times");
  std::string times =
      "| edges | convex corners | points | axis, ms | ms / edge |\n"
      "| ---: | ---: | ---: | ---: | ---: |\n";
  for (const int teeth : {24, 49, 99, 199, 399}) {
    const Shape shape = noisy_band(teeth, 0.3);
    Options options;
    options.method = Method::potential;
    options.threads = 1;
    double least = 1e300;
    std::size_t points = 0, corners = 0;
    const auto exact = compute(shape);
    for (const Node& node : exact->nodes) corners += node.disk.radius == 0 ? 1 : 0;
    for (int round = 0; round < 5; ++round) {
      const double begin = processor_seconds();
      const auto axis = compute(shape, options);
      least = std::min(least, processor_seconds() - begin);
      if (axis) points = axis->nodes.size();
    }
    const auto edges = static_cast<double>(shape.points.size());
    times += fmt::format("| {} | {} | {} | {:.2f} | {:.4f} |\n", shape.points.size(), corners,
                         points, 1e3 * least, 1e3 * least / edges);
  }
  progress("noise");
  std::string noise = "| axis | turns, degrees a size |\n| --- | ---: |\n";
  {
    const Shape shape = noisy_band(60, 0.2);
    for (const double order : {1.0, 4.0, 16.0, 64.0}) {
      Options options;
      options.method = Method::potential;
      options.threads = 1;
      options.potential.order = order;
      if (const auto axis = compute(shape, options))
        noise +=
            fmt::format("| {} | {:.0f} |\n", order_name(order), crookedness(*axis, size_of(shape)));
    }
  }
  report.text = fmt::format(
      "Distances in hundredths of the size (the larger side of the bounding box).\n\n"
      "## Largest distance from the skeleton to the exact axis\n\n{}\n"
      "## Mean distance\n\n{}\n## Orders along half a rectangle (Fig. 13)\n\n{}\n"
      "## Time of a noisy band (Fig. 8's kind), processor time of one thread\n\n{}\n"
      "## Smoothness against a noisy border (Fig. 7)\n\n{}",
      largest, mean, orders_along_rectangle(), times, noise);
  return report;
}

}  // namespace medial::cli

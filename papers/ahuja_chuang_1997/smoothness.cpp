#include "papers/ahuja_chuang_1997/smoothness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "axis/steps.h"
#include "medial/query.h"

namespace medial::papers {
namespace {

/// The edges from a node on to the furthest one, and that.
struct Way {
  std::vector<Step> steps;
  std::uint32_t end = 0;
};

Way furthest_from(const MedialAxis& axis, const Incidence& incidence, std::uint32_t start) {
  std::vector<double> length(axis.nodes.size(), -1);
  std::vector<Step> before(axis.nodes.size());
  std::vector<std::uint32_t> queue = {start};
  length[start] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const std::uint32_t e : incidence.edges(queue[i])) {
      const Edge& edge = axis.edges[e];
      const bool forward = edge.node[0] == queue[i];
      const std::uint32_t next = edge.node[forward ? 1 : 0];
      if (length[next] >= 0) continue;
      length[next] = length[queue[i]] + medial::length(axis, edge);
      before[next] = {e, forward};
      queue.push_back(next);
    }
  Way way;
  way.end =
      static_cast<std::uint32_t>(std::max_element(length.begin(), length.end()) - length.begin());
  for (std::uint32_t here = way.end; here != start;) {
    way.steps.push_back(before[here]);
    here = axis.edges[before[here].edge].node[before[here].forward ? 0 : 1];
  }
  std::reverse(way.steps.begin(), way.steps.end());
  return way;
}

/// The eight pixels around one, from the north on clockwise.
std::array<bool, 8> around(const Image& image, std::int64_t x, std::int64_t y) {
  return {image.at(x, y - 1), image.at(x + 1, y - 1), image.at(x + 1, y), image.at(x + 1, y + 1),
          image.at(x, y + 1), image.at(x - 1, y + 1), image.at(x - 1, y), image.at(x - 1, y - 1)};
}

bool goes(const std::array<bool, 8>& p, bool second) {
  const auto count = std::count(p.begin(), p.end(), true);
  int rises = 0;
  for (std::size_t i = 0; i < 8; ++i) rises += !p[i] && p[(i + 1) % 8] ? 1 : 0;
  const bool north = p[0], east = p[2], south = p[4], west = p[6];
  const bool open = second ? !(north && east && west) && !(north && south && west)
                           : !(north && east && south) && !(east && south && west);
  return count >= 2 && count <= 6 && rises == 1 && open;
}

template <class Act>
void each_pixel(const Image& image, const Act& act) {
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      if (image.at(x, y)) act(x, y);
}

}  // namespace

std::vector<Vec2> spine_of(const MedialAxis& axis, double step) {
  const Incidence incidence(axis);
  const std::uint32_t tip = furthest_from(axis, incidence, 0).end;
  std::vector<Vec2> line = {axis.nodes[tip].disk.center};
  // Steps of one length, so that exact and sampled axes turn in as many places.
  const Way way = furthest_from(axis, incidence, tip);
  for (const auto& [edge, forward] : way.steps) {
    auto disks = sample_by_step(axis, axis.edges[edge], 0.1 * step);
    if (!forward) std::reverse(disks.begin(), disks.end());
    for (const Disk& disk : disks)
      if (distance(line.back(), disk.center) >= step) line.push_back(disk.center);
  }
  return line;
}

double turning(const std::vector<Vec2>& line) {
  double sum = 0;
  for (std::size_t i = 2; i < line.size(); ++i) {
    const Vec2 in = line[i - 1] - line[i - 2], out = line[i] - line[i - 1];
    sum += std::abs(std::atan2(cross(in, out), dot(in, out)));
  }
  return sum * 180 / std::numbers::pi;
}

Image pixels_of(const Shape& shape, double side) {
  const Box box = bounding_box(shape);
  const auto pixels = [&](double length) {
    return static_cast<std::uint32_t>(std::ceil(length / side)) + 2;
  };
  Image image(pixels(box.high.x - box.low.x), pixels(box.high.y - box.low.y));
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      image.set(x, y,
                clearance(shape, {box.low.x + (x - 0.5) * side, box.low.y + (y - 0.5) * side}) > 0);
  return image;
}

Image thinned(Image image) {
  for (bool second = false, went = true, before = true; went || before; second = !second) {
    before = std::exchange(went, false);
    Image next = image;
    each_pixel(image, [&](std::uint32_t x, std::uint32_t y) {
      if (!goes(around(image, x, y), second)) return;
      next.set(x, y, false);
      went = true;
    });
    image = std::move(next);
  }
  return image;
}

std::uint64_t ends_of(const Image& image) {
  std::uint64_t ends = 0;
  each_pixel(image, [&](std::uint32_t x, std::uint32_t y) {
    const auto p = around(image, x, y);
    if (std::count(p.begin(), p.end(), true) == 1) ++ends;
  });
  return ends;
}

}  // namespace medial::papers

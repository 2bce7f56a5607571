#include "methods/potential/charges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/box_tree.h"

namespace medial::potential {
Charges::Charges(const std::vector<Charge>& pieces) {
  for (auto* array : {&start_x, &start_y, &tangent_x, &tangent_y, &lengths})
    array->reserve(pieces.size());
  for (const Charge& piece : pieces) {
    const Vec2 along = piece.end - piece.start;
    const double length = norm(along);
    start_x.push_back(piece.start.x);
    start_y.push_back(piece.start.y);
    tangent_x.push_back(along.x / length);
    tangent_y.push_back(along.y / length);
    lengths.push_back(length);
    site.push_back(piece.site);
  }
  nodes.reserve(4 * pieces.size() / leaf_size + 2);
  moments.reserve(nodes.capacity());
  build(0, static_cast<std::uint32_t>(pieces.size()));
}

std::uint32_t Charges::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes.size());
  nodes.emplace_back();
  moments.emplace_back();
  Node node;
  Moments own;
  node.begin = begin;
  node.end = end;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  node.box = {{infinity, infinity}, {-infinity, -infinity}};
  Vec2 moment;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec2 p : {start(i), start(i) + lengths[i] * tangent(i)}) {
      node.box.low = {std::min(node.box.low.x, p.x), std::min(node.box.low.y, p.y)};
      node.box.high = {std::max(node.box.high.x, p.x), std::max(node.box.high.y, p.y)};
    }
    node.length += lengths[i];
    moment = moment + lengths[i] * (start(i) + 0.5 * lengths[i] * tangent(i));
  }
  node.center = (1 / node.length) * moment;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Vec2 a = start(i) - node.center;
    node.radius = std::max({node.radius, norm(a), norm(a + lengths[i] * tangent(i))});
    if (end - begin <= leaf_size) own.add(a, tangent(i), lengths[i]);
  }
  if (end - begin > leaf_size) {
    // Whole blocks go to the left, so that most leaves are full.
    const std::uint32_t blocks = (end - begin + leaf_size - 1) / leaf_size;
    const std::uint32_t middle = begin + leaf_size * ((blocks + 1) / 2);
    const std::uint32_t left = build(begin, middle);
    node.right = build(middle, end);
    for (const std::uint32_t child : {left, node.right})
      own.add(moments[child], nodes[child].center - node.center);
  }
  nodes[index] = node;
  moments[index] = own;
  return index;
}

void Charges::squared_distances(Vec2 p, std::uint32_t begin, std::uint32_t end,
                                std::span<double, leaf_size> squares) const {
  for (std::uint32_t k = 0; k < end - begin; ++k) {
    const std::uint32_t i = begin + k;
    const double x = p.x - start_x[i], y = p.y - start_y[i];
    const double along = x * tangent_x[i] + y * tangent_y[i];
    const double aside = y * tangent_x[i] - x * tangent_y[i];
    const double beyond = std::max(std::max(-along, along - lengths[i]), 0.0);
    squares[k] = beyond * beyond + aside * aside;
  }
}

template <class Visit>
void Charges::from_near(Vec2 p, const double& limit, const Visit& visit) const {
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes[index];
    if (squared_distance(node.box, p) >= limit) continue;
    if (node.right == 0) {
      visit(node);
      continue;
    }
    const std::uint32_t left = index + 1;
    const bool left_first =
        squared_distance(nodes[left].box, p) <= squared_distance(nodes[node.right].box, p);
    stack[depth++] = left_first ? node.right : left;
    stack[depth++] = left_first ? left : node.right;
  }
}

Charges::Nearest Charges::nearest(Vec2 p) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};  // squared until the end
  from_near(p, best.distance, [&](const Node& leaf) {
    std::array<double, leaf_size> square;
    squared_distances(p, leaf.begin, leaf.end, square);
    for (std::uint32_t k = 0; k < leaf.end - leaf.begin; ++k) {
      if (square[k] < best.distance) best = {square[k], leaf.begin + k};
    }
  });
  best.distance = std::sqrt(best.distance);
  return best;
}

Vec2 Charges::nearest_ahead(Vec2 p, Vec2 a, Vec2 b) const {
  double limit = std::numeric_limits<double>::infinity();
  Vec2 best = p;
  from_near(p, limit, [&](const Node& leaf) {
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) {
      const Vec2 t = tangent(i);
      const Vec2 q = start(i) + std::clamp(dot(p - start(i), t), 0.0, lengths[i]) * t;
      const double square = squared_norm(q - p);
      if (!(square > 0 && square < limit) || dot(q - p, a) > 0 || dot(q - p, b) > 0) continue;
      limit = square;
      best = q;
    }
  });
  return best;
}

}  // namespace medial::potential

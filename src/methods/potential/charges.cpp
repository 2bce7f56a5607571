#include "methods/potential/charges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/box_tree.h"

namespace medial::potential {
namespace {

/// The number of pieces, out of `count`, on the left: whole leaves, so that most of them are full.
std::uint32_t left_half(std::size_t count) {
  const std::size_t leaves = (count + Charges::leaf_size - 1) / Charges::leaf_size;
  return static_cast<std::uint32_t>(Charges::leaf_size * ((leaves + 1) / 2));
}

/// Sorts pieces in space: halves them by the middle across the longer side of the box of their
/// middles, recursively down to leaves. In boundary order, sets would span several holes and be too
/// wide to be summed from afar. The result depends on the places, and on the order of charges at
/// the same place.
void sort_in_space(const std::vector<Vec2>& middles, std::span<std::uint32_t> order) {
  Box box = Box::nothing();
  for (const std::uint32_t i : order) box.add(middles[i]);
  const bool by_x = box.high.x - box.low.x >= box.high.y - box.low.y;
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = [&](std::uint32_t i) {
      const auto [x, y] = middles[i];
      return by_x ? std::tuple(x, y, i) : std::tuple(y, x, i);
    };
    return key(a) < key(b);
  };
  if (order.size() <= Charges::leaf_size) return std::sort(order.begin(), order.end(), is_before);
  const std::uint32_t middle = left_half(order.size());
  std::nth_element(order.begin(), order.begin() + middle, order.end(), is_before);
  sort_in_space(middles, order.first(middle));
  sort_in_space(middles, order.subspan(middle));
}

std::vector<std::uint32_t> order_of(const std::vector<Charge>& pieces) {
  std::vector<Vec2> middles;
  middles.reserve(pieces.size());
  for (const Charge& piece : pieces) middles.push_back(0.5 * (piece.start + piece.end));
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  sort_in_space(middles, order);
  return order;
}

}  // namespace

Charges::Charges(const std::vector<Charge>& pieces) : piece_(order_of(pieces)) {
  for (auto* array : {&start_x, &start_y, &tangent_x, &tangent_y, &lengths})
    array->reserve(pieces.size());
  for (const std::uint32_t i : piece_) {
    const Charge& piece = pieces[i];
    const Vec2 along = piece.end - piece.start;
    const double length = norm(along);
    start_x.push_back(piece.start.x);
    start_y.push_back(piece.start.y);
    tangent_x.push_back(along.x / length);
    tangent_y.push_back(along.y / length);
    lengths.push_back(length);
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
  node.box = Box::nothing();
  Vec2 moment;
  for (std::uint32_t i = begin; i < end; ++i) {
    node.box.add(start(i));
    node.box.add(start(i) + lengths[i] * tangent(i));
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
    const std::uint32_t middle = begin + left_half(end - begin);
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
    if (squared_distance(node.box, p) > limit) continue;
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
      const std::uint32_t piece = piece_[leaf.begin + k];
      if (square[k] < best.distance || (square[k] == best.distance && piece < best.piece))
        best = {square[k], piece};
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

#include "verify/piece_order.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "base/spatial_order.h"

namespace medial::verify_detail {
namespace {

/// Edges lie close to those that they join: fan_out that follow each other are a chain, of fewer
/// the last one stands there again, and chains are ordered as spatial_order() does. Where they lie
/// in each other's way, as rings in rings do, their pieces are ordered one by one.
class PieceOrder {
 public:
  explicit PieceOrder(const std::vector<BoundaryEdge>& pieces) : pieces_(pieces) {
    const auto count = static_cast<std::uint32_t>(pieces.size());
    for (std::uint32_t i = 0; i < count; ++i)
      if (i == 0 || i - begin_.back() == fan_out || !(pieces[i].start == pieces[i - 1].end))
        begin_.push_back(i);
    middle_.reserve(count);
    for (const BoundaryEdge& piece : pieces) middle_.push_back(midpoint(piece.start, piece.end));
    if (2 * fan_out * begin_.size() > 3 * pieces.size()) {  // too many would stand there again
      order_ = spatial_order(middle_, fan_out);
      return;
    }
    begin_.push_back(count);
    std::vector<std::uint32_t> chains(begin_.size() - 1);
    std::iota(chains.begin(), chains.end(), 0U);
    boxes_.assign(chains.size(), Box::nothing());
    for (const std::uint32_t c : chains)
      for (std::uint32_t i = begin_[c]; i < begin_[c + 1]; ++i)
        for_each_hull_point(pieces[i], [&](Vec2 p) { boxes_[c].add(p); });
    order_.reserve(fan_out * chains.size());
    add(chains);
  }
  std::vector<std::uint32_t> take() && { return std::move(order_); }

 private:
  static double area(const Box& of) { return (of.high.x - of.low.x) * (of.high.y - of.low.y); }
  void add(std::span<std::uint32_t> chains) {
    if (chains.size() <= fan_out) return add_pieces(chains);
    Box all = Box::nothing();
    double areas = 0;
    for (const std::uint32_t c : chains) {
      all.add(boxes_[c]);
      areas += area(boxes_[c]);
    }
    if (areas > most_overlap * area(all)) {
      std::sort(chains.begin(), chains.end());
      const std::size_t from = order_.size();
      add_pieces(chains);
      return order_overlapping(
          std::span(order_).subspan(from), [&](std::uint32_t i) { return middle_[i]; },
          [&](std::uint32_t i) { return pieces_[i].chord(); }, fan_out);
    }
    if (pieces_.size() <= few_pieces) return add_pieces(chains);
    const std::size_t half = detail::halve_by_place(
        chains, [&](std::uint32_t c) { return place(c); }, fan_out);
    add(chains.first(half));
    add(chains.subspan(half));
  }
  Vec2 place(std::uint32_t chain) const { return midpoint(boxes_[chain].low, boxes_[chain].high); }
  void add_pieces(std::span<const std::uint32_t> chains) {
    for (const std::uint32_t c : chains)
      for (std::uint32_t k = 0; k < fan_out; ++k)
        order_.push_back(std::min(begin_[c] + k, begin_[c + 1] - 1));
  }

  static constexpr double most_overlap = 2;
  const std::vector<BoundaryEdge>& pieces_;
  std::vector<std::uint32_t> begin_;  ///< of each chain, and the last one's end
  std::vector<Vec2> middle_;          ///< of each piece
  std::vector<Box> boxes_;            ///< of each chain
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::vector<std::uint32_t> order_of(const std::vector<BoundaryEdge>& pieces) {
  return PieceOrder(pieces).take();
}

}  // namespace medial::verify_detail

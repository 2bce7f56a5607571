#include <algorithm>
#include <utility>

#include "medial/contour.h"
#include "medial/io/read.h"

namespace medial::io {

namespace {

/// A contour of straight pieces and arcs as it is.
Chain chain_of(const Contour& contour) {
  Chain chain;
  if (contour.points.empty()) return chain;
  chain.points.push_back(contour.points.front());
  for (const CurvePiece& piece : contour.pieces) {
    chain.bulges.push_back(piece.bulge);
    chain.points.push_back(contour.points[piece.first + piece.degree]);
  }
  chain.closed = !contour.open;
  return chain;
}

}  // namespace

Result<std::vector<Chain>> chains_of(const Feature& feature, const ArcOptions& options) {
  std::vector<Chain> chains = feature.chains;
  for (const Ring& ring : feature.rings) chains.push_back({ring.points, ring.bulges, true});
  for (const Contour& contour : feature.contours) {
    const bool is_chain = std::ranges::all_of(
        contour.pieces, [](const CurvePiece& piece) { return piece.degree == 1; });
    if (is_chain) {
      chains.push_back(chain_of(contour));
      continue;
    }
    auto rings = approximate_by_arcs(std::span(&contour, 1), options);
    if (!rings) return std::move(rings).error();
    for (Ring& ring : *rings) {
      Chain chain{std::move(ring.points), std::move(ring.bulges), true};
      if (contour.open && contour.points.front() != contour.points.back()) {
        // What closes it is its last edge.
        chain.closed = false;
        if (!chain.bulges.empty()) chain.bulges.pop_back();
      }
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

}  // namespace medial::io

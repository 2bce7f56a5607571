#include <algorithm>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>

#include "load/suited_arcs.h"
#include "medial/load.h"

namespace medial {
namespace {

/// A contour of straight pieces and arcs as a chain, unchanged.
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

/// The chain of a free-form contour that has become a ring.
Chain chain_of(Ring ring, const Contour& contour) {
  Chain chain{std::move(ring.points), std::move(ring.bulges), true};
  if (contour.open && contour.points.front() != contour.points.back()) {
    // Drop the last edge, which closes it.
    chain.closed = false;
    if (!chain.bulges.empty()) chain.bulges.pop_back();
  }
  return chain;
}

/// A chain's feature in the file, and its number in that feature.
std::pair<std::uint64_t, std::uint64_t> place_of(const LoosePieces& pieces, std::uint64_t chain) {
  const std::uint32_t feature = pieces.feature[chain];
  const auto first = std::lower_bound(pieces.feature.begin(), pieces.feature.end(), feature);
  return {pieces.features.index_of(feature),
          chain - static_cast<std::uint64_t>(first - pieces.feature.begin())};
}

/// Translates an error that names a chain as its ring, and perhaps another chain in its text, to
/// features and rings.
Error in_terms_of_features(const LoosePieces& pieces, Error error) {
  if (!error.place.ring || *error.place.ring >= pieces.feature.size()) return error;
  std::tie(error.place.feature, error.place.ring) = place_of(pieces, *error.place.ring);
  const std::string marker = " of chain ";
  const std::size_t at = error.text.rfind(marker);
  if (at == std::string::npos) return error;
  const auto other = std::strtoull(error.text.c_str() + at + marker.size(), nullptr, 10);
  const auto [feature, chain] = place_of(pieces, other);
  error.text.replace(at, std::string::npos,
                     marker + std::to_string(chain) + " of feature " + std::to_string(feature));
  return error;
}

/// The whole content of a feature as chains. Errors: those of approximate_by_arcs().
Result<std::vector<Chain>> chains_of(const Feature& feature, const ArcOptions& options) {
  std::vector<Chain> chains = feature.chains;
  for (const Ring& ring : feature.rings) chains.push_back({ring.points, ring.bulges, true});
  for (const Contour& contour : feature.contours) {
    const bool is_chain = std::all_of(contour.pieces.begin(), contour.pieces.end(),
                                      [](const CurvePiece& piece) { return piece.degree == 1; });
    if (is_chain) {
      chains.push_back(chain_of(contour));
      continue;
    }
    auto rings = approximate_by_arcs(std::span(&contour, 1), options);
    if (!rings) return std::move(rings).error();
    for (Ring& ring : *rings) chains.push_back(chain_of(std::move(ring), contour));
  }
  return chains;
}

}  // namespace

Result<LoosePieces> load_loose(Document<Feature> features, const ArcOptions& options) {
  LoosePieces pieces;
  pieces.features = Document<Attributes>{features, {}};
  const ArcOptions arcs = suited_arcs(options, features);
  for (std::uint32_t i = 0; i < features.items.size(); ++i) {
    auto chains = chains_of(features.items[i], arcs);
    if (!chains) {
      chains.error().place.feature = features.index_of(i);
      return std::move(chains).error();
    }
    std::move(chains->begin(), chains->end(), std::back_inserter(pieces.chains));
    pieces.feature.resize(pieces.chains.size(), i);
    pieces.features.items.push_back(std::move(features.items[i].attributes));
  }
  return pieces;
}

Result<PlanarGraph> planar_graph_of(const LoosePieces& pieces, const PlanarGraphOptions& options) {
  auto graph = build_planar_graph(pieces.chains, options);
  if (!graph) return in_terms_of_features(pieces, std::move(graph).error());
  return graph;
}

Result<double> with_planar_graph(const LoosePieces& pieces, bool node_crossings,
                                 const std::function<Status(PlanarGraph& graph)>& use) {
  const auto is_too_close = [](const Error& error) {
    return error.code == ErrorCode::unsupported && error.place.ring && error.place.point;
  };
  auto graph = planar_graph_of(pieces, {.node_crossings = node_crossings});
  if (!graph) return std::move(graph).error();
  const double size = diagonal(bounding_box(*graph));
  Status used = use(*graph);
  double touching = 0;
  for (const double share : {0x1p-39, 0x1p-35, 0x1p-31}) {
    if (used || !is_too_close(used.error())) break;
    graph = planar_graph_of(pieces, {.node_crossings = node_crossings, .reach = share * size});
    if (!graph) continue;
    touching = share * size;
    used = use(*graph);
  }
  if (!used) return in_terms_of_features(pieces, std::move(used).error());
  return touching;
}

}  // namespace medial

#include "support/nasty_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "medial/medial.h"
#include "support/examine.h"
#include "support/property.h"
#include "support/same_graph.h"
#include "support/true_graph.h"

namespace medial::test {
namespace {

/// All that commit no rounding on any coordinates, in their numbers and names.
const std::vector<Symmetry>& exact_symmetries() {
  static const std::vector<Symmetry> all{
      {.name = "mirrored", .xx = -1},
      {.name = "turned by a quarter", .xx = 0, .xy = -1, .yx = 1, .yy = 0},
      {.name = "scaled by 2^-20", .xx = 0x1p-20, .yy = 0x1p-20},
      {.name = "from another start", .restart = 1},
      {.name = "mirrored, turned, doubled, from another start",
       .xx = 0,
       .xy = 2,
       .yx = 2,
       .yy = 0,
       .restart = 2}};
  return all;
}

Finding of_error(const Error& error, const std::string& where) {
  const bool refusal = is_refusal(error.code) && error.code != ErrorCode::malformed;
  return {error.code == ErrorCode::crossing ? Fault::refused  // by less than build_shape() can see
          : refusal                         ? Fault::unsupported
                                            : Fault::internal,
          where + to_string(error)};
}

/// The two sites of each edge.
std::vector<std::array<std::uint32_t, 2>> sites_of_edges(const MedialAxis& axis) {
  std::vector<std::array<std::uint32_t, 2>> sites;
  for (const Edge& edge : axis.edges)
    sites.push_back({std::min(edge.site[0], edge.site[1]), std::max(edge.site[0], edge.site[1])});
  std::sort(sites.begin(), sites.end());
  return sites;
}

/// Whether both are one disk: a circle's, which may be cut into arcs anywhere.
bool are_one_disk(const MedialAxis& a, const MedialAxis& b) {
  if (a.nodes.size() != 1 || b.nodes.size() != 1 || !a.edges.empty() || !b.edges.empty())
    return false;
  const Disk &first = a.nodes[0].disk, &second = b.nodes[0].disk;
  return distance(first.center, second.center) <= a.tolerance &&
         std::abs(first.radius - second.radius) <= a.tolerance;
}

/// The axis of an image against that of the shape.
Finding compare(const Shape& shape, const MedialAxis& axis, const Rings& rings,
                const Symmetry& symmetry, const Options& options) {
  const std::string where = symmetry.name + ": ";
  const auto image = build_shape(transformed(rings, symmetry));
  if (!image) return {Fault::asymmetric, where + to_string(image.error())};
  auto other = compute(*image, options);
  if (!other) {
    Finding finding = of_error(other.error(), where);
    if (finding.fault == Fault::refused) finding.fault = Fault::asymmetric;
    return finding;
  }
  if (const Certificate certificate = verify(*image, *other, {.threads = 1}); !certificate.passed)
    return {Fault::wrong, where + certificate.failures.front()};
  const MedialAxis back = moved_back(shape, axis.sites, *image, std::move(*other), symmetry);
  if (back.sites.empty() && are_one_disk(axis, back)) return {};
  if (back.sites.empty())
    return {shape.bulges.empty() ? Fault::asymmetric : Fault::loose, where + "other sites"};
  const std::string differs = difference(shape, axis, back, axis.tolerance);
  if (!differs.empty()) return {Fault::asymmetric, where + differs};
  if (back.nodes.size() != axis.nodes.size() || sites_of_edges(back) != sites_of_edges(axis))
    return {Fault::loose, where + "ties contracted elsewhere"};
  return {};
}

Finding compare_with_truth(const Shape& shape, const MedialAxis& axis) {
  const SiteGraph truth = true_graph(shape, axis.sites);
  if (!truth.failure.empty()) return {Fault::untrue, truth.failure, true};
  const std::string differs = difference(axis.sites, truth, graph_of(shape, axis), axis.tolerance);
  return {differs.empty() ? Fault::none : Fault::untrue, differs, true};
}

}  // namespace

std::string_view name_of(Fault fault) {
  constexpr std::array<std::string_view, all_faults.size()> names{
      "right", "refused", "internal", "unsupported", "wrong", "untrue", "asymmetric", "loose"};
  return names[static_cast<std::size_t>(fault)];
}

Finding examine_nasty(const Rings& rings, const NastyOptions& nasty) {
  const Options options{.method = nasty.method, .exact = nasty.exact, .threads = 1};
  const auto shape = build_shape(rings);
  if (!shape) return {Fault::refused, to_string(shape.error())};
  const auto axis = compute(*shape, options);
  if (!axis) return of_error(axis.error(), "");
  if (const Certificate certificate = verify(*shape, *axis, {.threads = 1}); !certificate.passed)
    return {Fault::wrong, certificate.failures.front()};
  Finding finding;
  if (nasty.oracle) finding = compare_with_truth(*shape, *axis);
  if (finding.fault != Fault::none || !nasty.images) return finding;
  const bool compared = finding.compared;
  for (const Symmetry& symmetry : exact_symmetries()) {
    Finding next = compare(*shape, *axis, rings, symmetry, options);
    if (next.fault != Fault::none && next.fault != Fault::loose) return next;
    if (finding.fault == Fault::none) finding = std::move(next);
  }
  Options two = options;
  two.threads = 2;
  const auto other = compute(*shape, two);
  if (!other || !identical(*axis, *other)) return {Fault::asymmetric, "with two threads"};
  finding.compared = compared;
  return finding;
}

Finding examine_nasty(const std::vector<Chain>& chains, const NastyOptions&) {
  Finding loose;
  std::optional<std::array<std::size_t, 2>> first;
  for (std::size_t i = 0; i <= exact_symmetries().size(); ++i) {
    const Symmetry symmetry = i == 0 ? Symmetry{.name = "as it is"} : exact_symmetries()[i - 1];
    const auto planar = build_planar_graph(transformed(chains, symmetry));
    if (!planar)
      return {i == 0 ? Fault::refused : Fault::asymmetric,
              symmetry.name + ": " + to_string(planar.error())};
    const auto diagram = voronoi_diagram(*planar, {.threads = 1});
    if (!diagram) return of_error(diagram.error(), symmetry.name + ": ");
    const VoronoiCertificate certificate = verify(*planar, *diagram, {.threads = 1});
    if (!certificate.passed)
      return {Fault::wrong, symmetry.name + ": " + certificate.failures.front()};
    const std::array<std::size_t, 2> counts{diagram->nodes.size(), diagram->edges.size()};
    if (!first) first = counts;
    if (*first != counts) loose = {Fault::loose, symmetry.name + ": other numbers of nodes"};
  }
  return loose;
}

Finding examine_nasty(const NastyClass& one, std::uint64_t seed, bool small,
                      const NastyOptions& options) {
  const auto chains = options.points ? nasty_chains_and_points : nasty_chains;
  Finding finding = options.planar ? examine_nasty(chains(one, seed, small), options)
                                   : examine_nasty(nasty_shape(one, seed, small), options);
  if (finding.fault > Fault::refused)
    finding.words = "seed " + std::to_string(seed) + (small ? ", small: " : ": ") + finding.words;
  return finding;
}

void Faults::add(const Finding& finding) {
  ++counts[finding.fault];
  compared += finding.compared ? 1 : 0;
  if (finding.fault > Fault::refused) first.emplace(finding.fault, finding.words);
}

std::uint64_t Faults::count(Fault fault) const {
  const auto found = counts.find(fault);
  return found == counts.end() ? 0 : found->second;
}

std::uint64_t Faults::wrong() const {
  std::uint64_t sum = 0;
  for (const auto& [fault, count] : counts) sum += fault > Fault::refused ? count : 0;
  return sum;
}

Rings smallest_like(const Rings& rings, const Finding& finding, const NastyOptions& options) {
  constexpr std::size_t budget = 600;
  return reduced(
      rings, [&](const Rings& part) { return examine_nasty(part, options).fault == finding.fault; },
      budget);
}

}  // namespace medial::test

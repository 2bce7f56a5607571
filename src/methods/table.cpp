#include "methods/table.h"

#include <algorithm>
#include <array>
#include <utility>

#include "methods/biarc_dc/biarc_dc.h"
#include "methods/checks.h"
#include "methods/curve_axis/curve_axis.h"
#include "methods/disks/disks.h"
#include "methods/lee/lee.h"
#include "methods/potential/potential.h"
#include "methods/raster/brushfire/brushfire.h"
#include "methods/raster/ridge/ridge.h"

namespace medial {
namespace {

/// A rule from measurements (docs/lee.md). About half of the vertices of coasts and mazes are
/// reflex, mostly fewer of smooth shapes. O(n).
bool is_lee_faster(const Problem& problem) {
  constexpr double most_reflex = 0.4;
  const Shape& shape = problem.shape;
  if (shape.hole_count() > 0 || has_arcs(shape) || problem.options.exact) return false;
  std::size_t reflex = 0;
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const std::span<const Vec2> loop = shape.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 before = loop[i == 0 ? loop.size() - 1 : i - 1], at = loop[i],
                 after = loop[i + 1 == loop.size() ? 0 : i + 1];
      reflex += cross(at - before, after - at) <= 0 ? 1 : 0;  // rounding does not matter
    }
  }
  return static_cast<double>(reflex) <= most_reflex * static_cast<double>(shape.points.size());
}

std::optional<Error> takes_all(const Problem&) { return std::nullopt; }

const std::array<MethodRow, std::variant_size_v<Method>> rows = {{
    {{.name = "disks",
      .summary = "walks from maximal disk to maximal disk",
      .exterior = true,
      .threads = true},
     method::Disks{},
     takes_all,
     [](const Problem& problem) { return outcome_of(disks::run(problem), false); }},
    {{.name = "biarc-dc",
      .summary = "the published randomised divide and conquer",
      .exterior = true,
      .threads = true},
     method::BiarcDc{},
     takes_all,
     [](const Problem& problem) { return outcome_of(biarc_dc::run(problem)); }},
    {{.name = "lee",
      .summary = "merges Voronoi diagrams of chains",
      .exterior = true,
      .threads = true},
     method::Lee{},
     takes_all,
     [](const Problem& problem) { return outcome_of(lee::run(problem), false); }},
    {{.name = "auto",
      .summary = "the faster one of disks and lee for each shape",
      .exterior = true,
      .threads = true},
     method::Auto{},
     takes_all,
     [](const Problem& problem) {
       return outcome_of(is_lee_faster(problem) ? lee::run(problem) : disks::run(problem), false);
     }},
    {{.name = "ridge",
      .summary = "follows ridges on a grid of pixels",
      .sampling = Sampling::pixels,
      .exterior = true},
     method::Ridge{},
     ridge::refuse,
     [](const Problem& problem) { return outcome_of(ridge::run(problem), false); }},
    {{.name = "brushfire", .summary = "thins the pixels of a grid", .sampling = Sampling::pixels},
     method::Brushfire{},
     brushfire::refuse,
     [](const Problem& problem) { return outcome_of(brushfire::run(problem), false); }},
    {{.name = "potential",
      .summary = "the valleys of a potential field",
      .sampling = Sampling::points,
      .exterior = true,
      .part = true,
      .threads = true},
     method::Potential{},
     potential::refuse,
     [](const Problem& problem) {
       return outcome_of(potential::run(problem), problem.own<method::Potential>().whole());
     }},
    {{.name = "curve-axis",
      .summary = "follows the axis from maxima of curvature and corners",
      .sampling = Sampling::points,
      .exterior = true,
      .contours = true},
     method::CurveAxis{},
     takes_all,
     [](const Problem& problem) { return outcome_of(curve_axis::run(problem), false); }},
}};

const auto infos = [] {
  std::array<MethodInfo, rows.size()> all{};
  std::transform(rows.begin(), rows.end(), all.begin(), [](const MethodRow& r) { return r.info; });
  return all;
}();

const MethodRow* find_row(std::string_view name) {
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const MethodRow& one) { return name == one.info.name; });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace

const MethodRow& row_of(const Method& method) { return rows[method.index()]; }
const MethodRow& solver_of(const Options& options) {
  return row_of(options.exact ? Method(method::Disks{}) : options.method);
}
const MethodInfo& info_of(const Method& method) { return row_of(method).info; }
std::span<const MethodInfo> methods() { return infos; }

std::optional<Method> method_from(std::string_view name) {
  const MethodRow* row = find_row(name);
  return row == nullptr ? std::nullopt : std::optional(row->defaults);
}

bool is_of_pixels(std::string_view method) {
  const MethodRow* row = find_row(method);
  return row != nullptr && row->info.sampling == Sampling::pixels;
}

}  // namespace medial

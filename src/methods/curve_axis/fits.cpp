#include "methods/curve_axis/fits.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "curve/bezier.h"
#include "curve/fit.h"
#include "medial/geometry.h"

namespace medial::curve_axis {
namespace {

using Polygons = std::span<const std::vector<Vec2>>;

bool crosses(ErrorCode code) {
  return code == ErrorCode::crossing || code == ErrorCode::overlap ||
         code == ErrorCode::hole_outside || code == ErrorCode::nested_outer;
}

/// The distance as text, with two digits.
std::string text_of(double within) {
  std::string text(16, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.2g", within)));
  return text;
}

/// Whether the method succeeds on the fit within the distance in `text`.
bool follows(Polygons polygons, const std::string& text, method::CurveAxis options,
             const std::atomic<bool>* cancel) {
  const auto curves = curve::fit_loops(polygons, std::strtod(text.c_str(), nullptr));
  return curves && follow_all(*curves, options, cancel).ok();
}

/// The first fit on which the method succeeds, of some multiples of `options.fit`; empty: none.
std::string next_fit(Polygons polygons, const method::CurveAxis& options,
                     const std::atomic<bool>* cancel) {
  for (const double factor :
       {1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 6.0, 0.8, 0.6, 0.4, 8.0, 11.0, 16.0, 0.25, 0.16, 0.1}) {
    if (cancel != nullptr && *cancel) break;
    const std::string text = text_of(factor * options.fit);
    if (follows(polygons, text, options, cancel)) return text;
  }
  return {};
}

/// The closest fit on which the method succeeds, of some shares of the diagonal; empty: none.
std::string closest_fit(Polygons polygons, const method::CurveAxis& options,
                        const std::atomic<bool>* cancel) {
  Box box = Box::nothing();
  for (const auto& polygon : polygons)
    for (const Vec2 p : polygon) box.add(p);
  std::string found;
  for (const double share : {0.05, 0.025, 0.012, 0.006, 0.003, 0.0015}) {
    if (cancel != nullptr && *cancel) break;
    const std::string text = text_of(share * distance(box.low, box.high));
    const bool is_followed = follows(polygons, text, options, cancel);
    if (!is_followed && !found.empty()) break;
    if (is_followed) found = text;
  }
  return found;
}

}  // namespace

Error with_fit_that_does(Error error, Polygons polygons, const method::CurveAxis& options,
                         const std::atomic<bool>* cancel) {
  const bool is_fit = options.fit > 0;
  if (is_fit && crosses(error.code)) {
    // The crossing loops and vertices belong to the fit: their numbers would mean nothing to the
    // caller.
    const auto point = error.place.point;
    error = {ErrorCode::unsupported, "the smooth curves of the fit cross here", {}};
    error.place.point = point;
  }
  if (error.code != ErrorCode::unsupported && error.code != ErrorCode::too_large) return error;
  const std::string fit =
      is_fit ? next_fit(polygons, options, cancel) : closest_fit(polygons, options, cancel);
  if (cancel != nullptr && *cancel) return Error{ErrorCode::cancelled, "cancelled", {}};
  if (!fit.empty()) error.text += "; --fit " + fit + " works";
  return error;
}

Result<CurveAxis> follow_fit(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel) {
  std::vector<std::vector<Vec2>> polygons;
  for (const Contour& contour : contours) polygons.push_back(curve::polygon_of(contour));
  const auto followed = [&]() -> Result<CurveAxis> {
    if (!(options.fit > 0)) return follow_all(contours, options, cancel);
    const auto curves = curve::fit_loops(polygons, options.fit);
    if (!curves) return curves.error();
    return follow_all(*curves, options, cancel);
  };
  Result<CurveAxis> result = followed();
  if (result) return result;
  return with_fit_that_does(std::move(result).error(), polygons, options, cancel);
}

}  // namespace medial::curve_axis

#include "io/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/counted.h"
#include "load/left_out.h"

namespace medial::io {

namespace {

std::optional<std::size_t> not_finite(const std::vector<Vec2>& points) {
  const auto bad = std::ranges::find_if(
      points, [](Vec2 p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  if (bad == points.end()) return std::nullopt;
  return static_cast<std::size_t>(bad - points.begin());
}

std::optional<std::size_t> not_finite(const std::vector<double>& numbers) {
  const auto bad = std::ranges::find_if_not(numbers, [](double x) { return std::isfinite(x); });
  if (bad == numbers.end()) return std::nullopt;
  return static_cast<std::size_t>(bad - numbers.begin());
}

Error error_not_finite(std::size_t line, std::size_t vertex, const char* what) {
  Error error{ErrorCode::not_finite, fmt::format("{} is not a finite number", what), {}};
  error.place.ring = line;
  error.place.vertex = vertex;
  return error;
}

/// The first number of rings or of chains that is not finite.
template <class Lines>
std::optional<Error> not_finite_in(const Lines& lines) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (auto at = not_finite(lines[k].points)) return error_not_finite(k, *at, "a coordinate");
    if (auto at = not_finite(lines[k].bulges)) return error_not_finite(k, *at, "a bulge");
  }
  return std::nullopt;
}

std::optional<Error> not_finite_in(const std::vector<Contour>& contours) {
  for (std::size_t k = 0; k < contours.size(); ++k) {
    const Contour& contour = contours[k];
    if (auto at = not_finite(contour.points)) return error_not_finite(k, *at, "a control point");
    if (auto at = not_finite(contour.weights)) return error_not_finite(k, *at, "a weight");
    for (const CurvePiece& piece : contour.pieces)
      if (!std::isfinite(piece.bulge)) return error_not_finite(k, piece.first, "a bulge");
  }
  return std::nullopt;
}

Status check_finite(const Feature& feature, std::size_t index) {
  auto error = not_finite_in(feature.rings);
  if (!error) error = not_finite_in(feature.chains);
  if (!error) error = not_finite_in(feature.contours);
  if (!error) return success();
  error->place.feature = index;
  return *error;
}

/// Leaves out what fails, with a note each if that may be skipped. Returns how many went.
Result<std::size_t> keep_valid(Document<Feature>& document, bool skip_invalid,
                               const std::function<Status(Feature&, std::uint64_t)>& check) {
  const std::size_t before = document.items.size();
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < before; ++i) {
    const Status status = check(document.items[i], document.index_of(i));
    if (!status && !skip_invalid) return status.error();
    if (status)
      kept.push_back(i);
    else
      document.notes.push_back(note_of_left_out(status.error()));
  }
  document.keep(kept);
  return before - kept.size();
}

/// Whether any feature is left, with a note on how many went.
Status note_invalid(std::size_t dropped, std::size_t before, std::vector<std::string>& notes) {
  if (dropped == 0) return success();
  if (dropped == before)
    return Error{ErrorCode::empty, "no feature is valid, so nothing is left", {}};
  notes.push_back(invalid_left_out(dropped, before));
  return success();
}

/// Polygons whose rings do not end where they began: build_shape() closes them.
std::size_t unclosed_rings(const Feature& feature) {
  return static_cast<std::size_t>(std::ranges::count_if(feature.rings, [](const Ring& ring) {
    return (ring.role == RingRole::outer || ring.role == RingRole::hole) &&
           ring.points.size() > 2 && ring.points.front() != ring.points.back();
  }));
}

bool is_empty(const Feature& feature) {
  return feature.chains.empty() &&
         std::ranges::all_of(feature.rings, [](const Ring& one) { return one.points.empty(); }) &&
         std::ranges::all_of(feature.contours, [](const Contour& contour) {
           return contour.pieces.empty() && !contour.open;
         });
}

}  // namespace

Status check_each(Document<Feature>& document, bool skip_invalid,
                  const std::function<Status(Feature&, std::uint64_t)>& check) {
  const std::size_t before = document.items.size();
  const Result<std::size_t> dropped = keep_valid(document, skip_invalid, check);
  if (!dropped) return dropped.error();
  return note_invalid(*dropped, before, document.notes);
}

Status FeatureChecks::check(Document<Feature>& part) {
  before_ += part.items.size();
  const Result<std::size_t> dropped = keep_valid(part, options_.skip_invalid, check_finite);
  if (!dropped) return dropped.error();
  invalid_ += *dropped;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < part.items.size(); ++i)
    if (!is_empty(part.items[i])) kept.push_back(i);
  empty_ += part.items.size() - kept.size();
  part.keep(kept);
  left_ += kept.size();
  for (const Feature& feature : part.items) unclosed_ += unclosed_rings(feature);
  return success();
}

Status FeatureChecks::finish(Document<Feature>& document) const {
  std::vector<std::string>& notes = document.notes;
  if (Status valid = note_invalid(invalid_, before_, notes); !valid) return valid;
  if (before_ == 0) notes.emplace_back(no_feature);
  if (left_ == 0 && before_ > 0)
    return Error{ErrorCode::empty,
                 options_.loose ? "the file contains no geometry" : "there is no polygon",
                 {}};
  if (empty_ > 0)
    notes.push_back(empty_ == 1 ? "1 feature is empty and was left out"
                                : fmt::format("{} features are empty and were left out", empty_));
  if (unclosed_ > 0)
    notes.push_back(
        unclosed_ == 1
            ? "1 ring does not end at its first point and was closed by a straight edge"
            : fmt::format("{} rings do not end at their first points and were closed by straight "
                          "edges",
                          unclosed_));
  return success();
}

}  // namespace medial::io

#include "medial/error.h"

#include <array>
#include <exception>
#include <new>

#include "base/compat.h"
#include "base/in_flight.h"

namespace medial {
namespace {

void append(std::string& list, const char* noun, const std::optional<std::uint64_t>& number) {
  if (!number) return;
  if (!list.empty()) list += ", ";
  list += noun;
  list += ' ';
  list += std::to_string(*number);
}

}  // namespace

Error error_in_flight() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {ErrorCode::out_of_memory, "memory ran out", {}};
  } catch (const std::exception& exception) {
    return {ErrorCode::internal, exception.what(), {}};
  } catch (...) {
    return {ErrorCode::internal, "something unexpected happened", {}};
  }
}

const char* name_of(ErrorCode code) {
  // In the order of the codes.
  static constexpr std::array names{
      "not_finite",     "too_few_points", "no_area",       "crossing",     "overlap",
      "hole_outside",   "nested_outer",   "open_surface",  "non_manifold", "too_large",
      "empty",          "unreadable",     "malformed",     "unsupported",  "unwritable",
      "invalid_option", "cancelled",      "out_of_memory", "internal"};
  static_assert(names.size() == static_cast<std::size_t>(ErrorCode::internal) + 1);
  return names[static_cast<std::size_t>(code)];
}

std::string to_string(const Error& error) {
  const Place& place = error.place;
  std::string where;
  append(where, "line", place.line);
  append(where, "feature", place.feature);
  // Errors of planar graphs name chains, which the place counts as rings.
  append(where, error.text.find(" of chain ") == std::string::npos ? "ring" : "chain", place.ring);
  append(where, "vertex", place.vertex);
  append(where, "face", place.face);
  if (place.point) {
    // For a crossing, the point is where the edge that starts at the vertex crosses another edge.
    const bool is_beside = error.code == ErrorCode::crossing &&
                           error.text.find("starts at this vertex") != std::string::npos;
    if (!where.empty()) where += is_beside ? ", crossing " : " ";
    where += "at (" + shortest_text(place.point->x) + ", " + shortest_text(place.point->y);
    if (place.z) where += ", " + shortest_text(*place.z);
    where += ")";
  }
  std::string sentence;
  if (!place.file.empty()) sentence += place.file + ": ";
  if (!where.empty()) sentence += where + ": ";
  return sentence + error.text + " [" + name_of(error.code) + "]";
}

}  // namespace medial

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "medial/geometry.h"

namespace medial {

/// The kind of an error. The names are stable: `--json` prints them.
enum class ErrorCode : std::uint8_t {
  not_finite,      ///< a coordinate is NaN or infinite
  too_few_points,  ///< a ring has fewer than three distinct points
  no_area,         ///< a ring (or the whole input) encloses no area
  crossing,        ///< two edges cross
  overlap,         ///< two edges share more than a point
  hole_outside,    ///< a hole lies outside every outer ring
  nested_outer,    ///< an outer ring lies inside another outer ring
  open_surface,    ///< an edge of a mesh has one face only
  non_manifold,    ///< an edge of a mesh has more than two faces
  too_large,       ///< more sites than 32-bit indices allow, or more memory than permitted
  empty,           ///< no ring, no feature, nothing to do
  unreadable,      ///< a file cannot be opened or read
  malformed,       ///< the content of a file violates its format
  unsupported,     ///< a format, geometry or option that this build or command lacks
  unwritable,      ///< an output cannot be written
  invalid_option,  ///< an option is out of its range, or not for such an input
  cancelled,       ///< the caller asked to stop
  out_of_memory,   ///< memory ran out
  internal,        ///< a bug of the library: please report it
};

const char* name_of(ErrorCode code);  ///< as it is spelled above

/// The place of an error; every part is optional. Indices count from 0.
struct Place {
  std::string file;
  std::optional<std::uint64_t> feature;       ///< index in the file
  std::optional<std::uint64_t> ring, vertex;  ///< in the feature or the input; in the ring
  std::optional<std::uint64_t> face;          ///< index in the mesh
  std::optional<Vec2> point;                  ///< coordinates, in units of the input
  std::optional<double> z;                    ///< the third coordinate of the point, in space
  std::optional<std::uint64_t> line;          ///< line of a text file, from 1
};

/// An error as a value. The library never prints, exits, or lets an exception out.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string text;  ///< one sentence, no trailing full stop, no place
  Place place;
};

std::string to_string(const Error& error);  ///< "FILE: feature 3, vertex 7 at (x, y): text [code]"

/// Either a value or an error; access to the other one throws std::bad_variant_access.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return std::get<0>(content_); }
  const T& value() const& { return std::get<0>(content_); }
  T&& value() && { return std::get<0>(std::move(content_)); }
  T* operator->() { return &std::get<0>(content_); }
  const T* operator->() const { return &std::get<0>(content_); }
  T& operator*() & { return std::get<0>(content_); }
  const T& operator*() const& { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }

  Error& error() & { return std::get<1>(content_); }
  const Error& error() const& { return std::get<1>(content_); }
  Error&& error() && { return std::get<1>(std::move(content_)); }

 private:
  std::variant<T, Error> content_;
};

using Status = Result<std::monostate>;  ///< the result of an action without a value
inline Status success() { return std::monostate{}; }

}  // namespace medial

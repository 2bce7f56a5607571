#pragma once

#include <fast_float/fast_float.h>
#include <simdjson.h>

#include <string_view>

namespace medial::io {

/// The nearest double of a number. Throws simdjson_error if the value is not a number.
///
/// simdjson 3.0.1 misreads some numbers of more than 18 digits, by any amount; so these are read
/// once more.
inline double nearest_double(simdjson::ondemand::value value) {
  constexpr std::size_t well_read = 18;
  const std::string_view text = value.raw_json_token();  // and the space behind it
  double result = value.get_double();
  if (text.size() > well_read) fast_float::from_chars(text.begin(), text.end(), result);
  return result;
}

}  // namespace medial::io

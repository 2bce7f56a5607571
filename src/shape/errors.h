#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

inline Error error_without_place(ErrorCode code, std::string text) {
  Error error;
  error.code = code;
  error.text = std::move(text);
  return error;
}

inline Error error_of_ring(ErrorCode code, std::string text, std::uint64_t ring) {
  Error error = error_without_place(code, std::move(text));
  error.place.ring = ring;
  return error;
}

inline Error error_at(ErrorCode code, std::string text, VertexSource source, Vec2 point) {
  Error error = error_of_ring(code, std::move(text), source.ring);
  error.place.vertex = source.vertex;
  error.place.point = point;
  return error;
}

}  // namespace medial

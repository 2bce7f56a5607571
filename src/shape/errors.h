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

/// The text of the error that an edge crosses or overlaps the edge that starts at a vertex of
/// another ring or chain.
inline std::string text_of_edges(ErrorCode code, VertexSource other, const char* line = "ring") {
  return std::string("the edge that starts at this vertex ") +
         (code == ErrorCode::overlap ? "overlaps" : "crosses") +
         " the edge that starts at vertex " + std::to_string(other.vertex) + " of " + line + " " +
         std::to_string(other.ring);
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

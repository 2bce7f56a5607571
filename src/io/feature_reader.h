#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"

namespace medial::io {

/// The features of a file, one after another.
class FeatureReader {
 public:
  FeatureReader() = default;
  FeatureReader(const FeatureReader&) = delete;
  FeatureReader& operator=(const FeatureReader&) = delete;
  virtual ~FeatureReader() = default;

  /// Appends features, each with its number in the file, until they have `points` points or the
  /// file ends, and sets what holds for all of them, as far as it is known; notes are those that
  /// are new. Returns false at the end. Errors: those of reading the format.
  virtual Result<bool> read(std::size_t points, Document<Feature>& document) = 0;
  /// Begins again, after the end: what is now known of all features need not be found again. False:
  /// the file is to be opened again.
  virtual bool begin_again() { return false; }
};

/// Thrown by read() in the first pass: another reader is to read the file, from its beginning.
struct Unusual {};

/// All of them; `indices` stays empty where none was left out.
inline Result<Document<Feature>> read_to_end(FeatureReader& reader) {
  Document<Feature> document;
  constexpr std::size_t many = std::size_t{1} << 20;
  for (;;) {
    Result<bool> more = reader.read(many, document);
    if (!more) return std::move(more).error();
    if (!*more) break;
  }
  const std::size_t count = document.items.size();
  if (count > 0 && document.indices.back() + 1 == count) document.indices.clear();
  return document;
}

/// The error of a file with so many geometries, none of which is a polygon.
inline Error without_polygons(std::uint64_t others) {
  return {ErrorCode::unsupported,
          fmt::format("no polygons, only {} other geometr{}: points and lines are for `medial "
                      "voronoi` and `medial offset --loose`",
                      others, others == 1 ? "y" : "ies"),
          {}};
}

/// The note on a file with polygons and so many other geometries.
inline std::string note_of_others(std::uint64_t others) {
  return others == 1 ? std::string("1 geometry is not a polygon and was left out")
                     : fmt::format("{} geometries are not polygons and were left out", others);
}

inline std::size_t point_count(const Feature& feature) {
  std::size_t count = 1;
  for (const Ring& ring : feature.rings) count += ring.points.size();
  for (const Contour& contour : feature.contours) count += contour.points.size();
  for (const Chain& chain : feature.chains) count += chain.points.size();
  return count;
}

}  // namespace medial::io

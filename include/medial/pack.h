#pragma once

// Shapes as compact codes within a bound: axes as few quantised disks whose hulls are joined
// (Volkmann and St. Clair, Section II.A.3), images as maximal squares (Ahuja, Davis, Milgram and
// Rosenfeld 1978). Packs are files of codes: medial/io/read.h and write.h.

#include "medial/axis.h"
#include "medial/raster.h"

namespace medial {

/// Streams of numbers of one kind each, which compress better apart. The first is the structure.
constexpr std::size_t code_streams = 4;
using ShapeCode = std::array<std::vector<std::uint8_t>, code_streams>;

struct PackOptions {
  /// Largest change, in units of the input; positive. Unpacked shape and original lie within this
  /// distance of each other; what lies deeper inside is in both.
  double error = 0;
  double quantum_share = 0.3;  ///< of `error`: what quantisation takes; below 15/16
  double prune_share = 0.9;    ///< of the rest: what dropping branches takes; in (0, 15/16]
};

struct PackReport {
  std::uint64_t disks = 0, lines = 0, branches = 0;  ///< coded; branches kept; of the axes
  double quantum = 0;                                ///< step of the numbers, in units of the input
};

/// Drops branches that the disk at their base, grown by a part of the error, covers (erosion
/// thickness); codes the others as polylines of disks. O(n log n). Errors: invalid_option (an error
/// that is not positive, or below 2^-40 of the coordinates), not_finite.
Result<ShapeCode> encode_axes(std::span<const MedialAxis> axes, const PackOptions& options,
                              PackReport* report = nullptr);

/// The axes of a code: nodes and straight edges without sites, `resolution` their error. The shape
/// is the union of the hulls of each edge's two disks. O(code). Errors: malformed, unsupported.
Result<std::vector<MedialAxis>> decode_axes(const ShapeCode& code);

/// The boundary simplified within `error` (Douglas, Peucker), to compare sizes; without a decoder.
Result<ShapeCode> encode_boundary(std::span<const Shape> shapes, double error);

struct SquareReport {
  std::uint64_t squares = 0, missing = 0;  ///< foreground pixels that no square covers
};

/// Codes an image as maximal squares of foreground pixels: first those mostly not covered by
/// others, the largest first, until every foreground pixel is within `error` pixels (in x and in y)
/// of a covered one; 0 keeps the image. O(pixels log(pixels)) at most.
ShapeCode encode_squares(const Image& image, std::uint32_t error = 0,
                         SquareReport* report = nullptr);
Result<Image> decode_squares(const ShapeCode& code);  ///< errors: malformed, too_large

}  // namespace medial

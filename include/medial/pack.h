#pragma once

// Compact codes of shapes within an error: axes as few quantised disks whose hulls are joined
// (Volkmann and St. Clair, Section II.A.3), images as maximal squares (Ahuja, Davis, Milgram and
// Rosenfeld 1978). Packs are files of codes: medial/io/read.h and write.h.

#include "medial/axis.h"
#include "medial/raster.h"

namespace medial {

/// Streams that hold one kind of number each, to compress better. The first is the structure.
constexpr std::size_t code_streams = 4;
using ShapeCode = std::array<std::vector<std::uint8_t>, code_streams>;

struct PackOptions {
  /// Largest change, positive, in units of the input: the Hausdorff distance of the unpacked shape
  /// and the original is at most this, and points deeper inside one are in both.
  double error = 0;
  double quantum_share = 0.3;  ///< share of `error` used by quantisation; below 15/16
  double prune_share = 0.9;    ///< share of the rest used by dropping branches; in (0, 15/16]
};

struct PackReport {
  std::uint64_t disks = 0, lines = 0, branches = 0;  ///< coded; branches kept
  double quantum = 0;                                ///< of the numbers, in units of the input
};

/// Drops branches that the disk at their base covers when grown by a part of the error (erosion
/// thickness), and codes the others as polylines of disks. O(n log n). Errors: invalid_option (an
/// error that is not positive, below 1e-9 of the extent or 2^-50 of a coordinate), not_finite.
Result<ShapeCode> encode_axes(std::span<const MedialAxis> axes, const PackOptions& options,
                              PackReport* report = nullptr);

/// The axes of a code: nodes and straight edges without sites; `resolution` is the error. The shape
/// is the union of the hulls of each edge's two disks. O(code). Errors: malformed, unsupported.
Result<std::vector<MedialAxis>> decode_axes(const ShapeCode& code);

/// The boundary simplified within `error` (Douglas, Peucker), to compare sizes; has no decoder.
Result<ShapeCode> encode_boundary(std::span<const Shape> shapes, double error);

struct SquareReport {
  std::uint64_t squares = 0, missing = 0;  ///< foreground pixels that no square covers
};

/// Codes an image as maximal squares of foreground pixels, chosen largest first, preferring those
/// mostly not covered yet, until every foreground pixel is within `error` pixels (in x and in y) of
/// a covered one; 0 is lossless. O(m log(m)) for m pixels and sides of all maximal squares.
ShapeCode encode_squares(const Image& image, std::uint32_t error = 0,
                         SquareReport* report = nullptr);
Result<Image> decode_squares(const ShapeCode& code);  ///< errors: malformed, too_large

}  // namespace medial

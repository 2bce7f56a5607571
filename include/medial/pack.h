#pragma once

// Axes as compact codes of shapes, within a bound: as few disks as do, quantised, their hulls
// joined (Volkmann and St. Clair, Section II.A.3, of disks); and images as maximal squares, after
// Ahuja, Davis, Milgram and Rosenfeld (1978). The codes here are bytes to be compressed;
// medial/io/pack.h writes them to files.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/image.h"
#include "medial/shape.h"

namespace medial {

/// Streams of numbers of one kind each, as bytes: they compress better apart. The first is the
/// structure.
constexpr std::size_t code_streams = 4;
using ShapeCode = std::array<std::vector<std::uint8_t>, code_streams>;

struct PackOptions {
  /// How far the shape may change, in units of the input; positive. The unpacked shape lies within
  /// this distance of the original, and the original within this distance of it; and what lies
  /// deeper than this inside of the original is in it.
  double error = 0;
  /// Of `error`: what quantisation takes (below 15/16), and the share of the rest that dropping
  /// branches may take (in (0, 15/16]).
  double quantum_share = 0.3;
  double prune_share = 0.9;
};

struct PackReport {
  std::uint64_t disks = 0;     ///< coded
  std::uint64_t lines = 0;     ///< polylines of disks: branches that were kept
  std::uint64_t branches = 0;  ///< of the axes
  double quantum = 0;          ///< step of the numbers, in units of the input
};

/// Codes axes. Branches are dropped as far as the disk at their base, grown by a part of the error,
/// covers what is beyond them (erosion thickness); the others become polylines of disks; numbers
/// are whole multiples of one quantum. O(n log n). Errors: invalid_option (an error that is not
/// positive, or below 2^-40 of the coordinates), not_finite.
Result<ShapeCode> encode_axes(std::span<const MedialAxis> axes, const PackOptions& options,
                              PackReport* report = nullptr);

/// The axes of a code: nodes and straight edges without sites, `resolution` the error that they
/// were coded with. Their shape is the union of the disks along the edges: of the convex hulls of
/// the disks at their ends. Memory in the order of the code. Errors: malformed, unsupported.
Result<std::vector<MedialAxis>> decode_axes(const ShapeCode& code);

/// What the boundary itself takes in the same way, to compare: loops simplified within `error`
/// (Douglas and Peucker), quantised, differences. There is no decoder: only sizes matter.
Result<ShapeCode> encode_boundary(std::span<const Shape> shapes, double error);

struct SquareReport {
  std::uint64_t squares = 0;
  std::uint64_t missing = 0;  ///< foreground pixels that no square covers
};

/// Codes an image as squares of foreground pixels, none of background: maximal ones, first those of
/// which no other covers half, the largest first, then less, until all is covered. No foreground
/// pixel is further than `error` pixels (in x and in y) from one that is covered; with 0 the image
/// is kept. O(pixels log(pixels)) at most.
ShapeCode encode_squares(const Image& image, std::uint32_t error = 0,
                         SquareReport* report = nullptr);
/// Errors: malformed, too_large.
Result<Image> decode_squares(const ShapeCode& code);

}  // namespace medial

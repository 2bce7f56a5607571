#include <algorithm>
#include <array>

#include "base/in_flight.h"
#include "medial/raster.h"
#include "methods/raster/brushfire/front.h"
#include "methods/raster/brushfire/rules.h"
#include "methods/raster/brushfire/tiles.h"

namespace medial {
namespace {

using brushfire::Front;
using brushfire::Neighbors;
using brushfire::Tile;
using brushfire::Tiles;

/// Runs passes of the fire until nothing burns any more. `pass(front)` deletes the pixels of one
/// pass by Front::burn().
template <class Pass>
Status burn_down(Tiles& tiles, int reach, const BrushfireOptions& options, const Pass& pass) {
  Front front(tiles, reach);
  while (front.advance()) {
    pass(front);
    if (options.cancel != nullptr && options.cancel->load())
      return Error{ErrorCode::cancelled, "cancelled", {}};
    if (options.progress) options.progress(front.share_done());
  }
  return success();
}

/// Border pixels of the pass's beginning, one at a time in the order of four subfields. Pixels of
/// one subfield do not touch each other, so that deleting them at once is deleting them in any
/// order.
Status sequential(Tiles& tiles, const BrushfireOptions& options) {
  constexpr Tile even_columns = 0x5555555555555555;
  constexpr Tile even_rows = 0x00ff00ff00ff00ff;
  constexpr std::array subfields = {even_columns & even_rows, ~even_columns & ~even_rows,
                                    ~even_columns & even_rows, even_columns & ~even_rows};
  std::vector<Tile> border(tiles.size());
  return burn_down(tiles, 1, options, [&](Front& front) {
    front.for_each([&](std::size_t i) { border[i] = at_border(tiles.neighbors(i)); });
    for (const Tile subfield : subfields) {
      front.burn([&](std::size_t i) {
        const Tile candidates = tiles[i] & border[i] & subfield;
        if (candidates == 0) return candidates;
        const Neighbors p = tiles.neighbors(i);
        return candidates & simple(p) & not_an_end(p);
      });
    }
  });
}

Status sides(Tiles& tiles, const BrushfireOptions& options) {
  constexpr std::array order = {&Neighbors::n, &Neighbors::s, &Neighbors::w, &Neighbors::e};
  return burn_down(tiles, 1, options, [&](Front& front) {
    for (const auto side : order) {
      front.burn([&](std::size_t i) {
        const Neighbors p = tiles.neighbors(i);
        return tiles[i] & ~(p.*side) & simple(p) & not_an_end(p);
      });
    }
  });
}

Status marking(Tiles& tiles, const BrushfireOptions& options) {
  return burn_down(tiles, 1, options, [&](Front& front) {
    for (const bool first : {true, false})
      front.burn([&](std::size_t i) { return tiles[i] & guo_hall(tiles.neighbors(i), first); });
  });
}

/// All simple pixels that are no ends, from all sides at once. Deleting them all would break the
/// topology exactly where a critical clique would go as a whole: two pixels side by side whose
/// common edge has contact to others at both of its ends or at none; or all pixels around a common
/// corner, if two of them meet in nothing more than the corner. Of these the first stays, in the
/// order of rows. What stays holds the critical kernel (Bertrand and Couprie 2008).
Status simultaneous(Tiles& tiles, const BrushfireOptions& options) {
  Tiles goes(
      tiles);  // the pixels that the rule deletes, as far as computed; correct beyond the front
  return burn_down(tiles, 2, options, [&](Front& front) {
    front.for_each([&](std::size_t i) {
      const Neighbors p = tiles.neighbors(i);
      goes[i] = tiles[i] & simple(p) & not_an_end(p);
    });
    front.burn([&](std::size_t i) {
      const Tile self = goes[i];
      if (self == 0) return self;
      const Neighbors p = tiles.neighbors(i);
      const Neighbors q = goes.neighbors(i);
      // The pixel is the west or north one of an edge.
      const Tile beside = q.e & ~((p.n | p.ne) ^ (p.s | p.se));
      const Tile above = q.s & ~((p.w | p.sw) ^ (p.e | p.se));
      // The pixel is the first around its south-eastern corner, or with the north-western one
      // missing the first around its south-western.
      const Tile south_east = (p.se | (p.e & p.s)) & (q.e | ~p.e) & (q.s | ~p.s) & (q.se | ~p.se);
      const Tile south_west = ~p.w & p.sw & q.sw & (q.s | ~p.s);
      return self & ~(beside | above | south_east | south_west);
    });
  });
}

Status burn(Tiles& tiles, const BrushfireOptions& options) {
  switch (options.family) {
    case Brushfire::sequential:
      return sequential(tiles, options);
    case Brushfire::sides:
      return sides(tiles, options);
    case Brushfire::marking:
      return marking(tiles, options);
    case Brushfire::simultaneous:
      break;
  }
  return simultaneous(tiles, options);
}

constexpr std::array<std::pair<Brushfire, const char*>, 4> family_names = {
    {{Brushfire::sequential, "sequential"},
     {Brushfire::sides, "sides"},
     {Brushfire::marking, "marking"},
     {Brushfire::simultaneous, "simultaneous"}}};

}  // namespace

const char* name_of(Brushfire family) {
  for (const auto& [known, name] : family_names)
    if (known == family) return name;
  return "";
}

std::optional<Brushfire> brushfire_from(std::string_view name) {
  for (const auto& [family, known] : family_names)
    if (name == known) return family;
  return std::nullopt;
}

Result<Image> thin(const Image& image, const BrushfireOptions& options) {
  if (!fits_image(image.width(), image.height()))
    return Error{ErrorCode::too_large, "the diagonal of the image is above 2^16 pixels", {}};
  try {
    Tiles tiles(image);
    if (Status burnt = burn(tiles, options); !burnt) return std::move(burnt).error();
    return tiles.image(image.width(), image.height());
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "methods/raster/brushfire/tiles.h"

namespace medial::brushfire {

/// The front of the fire: the tiles in or near which something changed since all rules were last
/// applied there. Applying the rules to other tiles would not delete anything. So a pass over the
/// front is equivalent to a pass over the image, and each deleted pixel costs O(1) tiles.
class Front {
 public:
  /// `reach` is the largest distance, in pixels, at which a change affects a rule: 1 or 2. The
  /// tiles must outlive the front, and may change only by burn().
  Front(Tiles& tiles, int reach)
      : tiles_(tiles),
        listed_(tiles.size(), 0),
        north_(reach > 1 ? north_row | north_row << 8 : north_row),
        south_(reach > 1 ? south_row | south_row >> 8 : south_row),
        west_(reach > 1 ? west_column | west_column << 1 : west_column),
        east_(reach > 1 ? east_column | east_column >> 1 : east_column) {
    for (std::size_t row = 0; row < tiles.rows(); ++row) {
      for (std::size_t column = 0; column < tiles.columns(); ++column) {
        const std::size_t i = tiles.index(column, row);
        if (tiles[i] == 0) continue;
        list(i, in_next, next_);
        total_ += static_cast<unsigned>(std::popcount(tiles[i]));
      }
    }
  }

  /// Starts the next pass. Returns false if nothing is left to do.
  bool advance() {
    for (const std::size_t i : current_) listed_[i] &= static_cast<std::uint8_t>(~in_current);
    current_.clear();
    std::swap(current_, next_);
    for (const std::size_t i : current_) listed_[i] = in_current;
    return !current_.empty();
  }

  /// Calls work(i) for each tile of the front.
  template <class Work>
  void for_each(const Work& work) const {
    for (const std::uint32_t i : current_) work(i);
  }

  /// Deletes the pixels that rule(i) returns for each tile of the front, all at once: the rules see
  /// the image before the deletion. Tiles close to changes join the front of this pass and of the
  /// next one.
  template <class Rule>
  void burn(const Rule& rule) {
    doomed_.clear();
    for (const std::uint32_t i : current_) {
      if (tiles_[i] == 0) continue;
      if (const Tile pixels = rule(i); pixels != 0) doomed_.push_back({i, pixels});
    }
    for (const auto& [i, pixels] : doomed_) remove(i, pixels);
  }

  /// A lower bound on the share of pixels that need no more work.
  double share_done() const {
    return total_ == 0 ? 1 : static_cast<double>(deleted_) / static_cast<double>(total_);
  }

 private:
  static constexpr std::uint8_t in_current = 1;
  static constexpr std::uint8_t in_next = 2;

  void remove(std::uint32_t i, Tile pixels) {
    tiles_[i] &= ~pixels;
    deleted_ += static_cast<unsigned>(std::popcount(pixels));
    const auto stride = static_cast<std::uint32_t>(tiles_.stride());
    list(i, in_current, current_);
    list(i, in_next, next_);
    if (pixels & north_) touch(i - stride);
    if (pixels & south_) touch(i + stride);
    if (pixels & west_) touch(i - 1);
    if (pixels & east_) touch(i + 1);
    if (pixels & north_ & west_) touch(i - stride - 1);
    if (pixels & north_ & east_) touch(i - stride + 1);
    if (pixels & south_ & west_) touch(i + stride - 1);
    if (pixels & south_ & east_) touch(i + stride + 1);
  }

  void touch(std::uint32_t i) {
    if (tiles_[i] == 0) return;
    list(i, in_current, current_);
    list(i, in_next, next_);
  }

  void list(std::size_t i, std::uint8_t flag, std::vector<std::uint32_t>& tiles) {
    if (listed_[i] & flag) return;
    listed_[i] |= flag;
    tiles.push_back(static_cast<std::uint32_t>(i));
  }

  Tiles& tiles_;
  std::vector<std::uint8_t> listed_;
  std::vector<std::uint32_t> current_, next_;
  std::vector<std::pair<std::uint32_t, Tile>> doomed_;
  Tile north_, south_, west_, east_;
  std::uint64_t total_ = 0;
  std::uint64_t deleted_ = 0;
};

}  // namespace medial::brushfire

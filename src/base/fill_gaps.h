#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace medial {

/// Removes the elements at the increasing indices `gone`. Moves the last elements to their places,
/// and calls moved(from, to) for each move.
template <class T, class Gone, class Moved>
void fill_gaps(std::vector<T>& elements, const Gone& gone, Moved&& moved) {
  const std::size_t kept = elements.size() - gone.size();
  auto gap = gone.begin();
  auto skipped = std::lower_bound(gone.begin(), gone.end(), kept);
  for (std::size_t from = kept; from < elements.size(); ++from) {
    if (skipped != gone.end() && *skipped == from) {
      ++skipped;
      continue;
    }
    elements[*gap] = elements[from];
    moved(static_cast<std::uint32_t>(from), *gap++);
  }
  elements.resize(kept);
}

}  // namespace medial

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"

namespace medial {

/// An error that names an item of a document, in terms of the document's file.
inline Error in_file_of(const DocumentInfo& document, Error error) {
  if (auto& feature = error.place.feature) feature = document.index_of(*feature);
  return error;
}

/// On a feature that an error names.
inline std::string note_of_left_out(const Error& error) { return "left out: " + to_string(error); }

/// The items at these places.
template <class T>
std::vector<T> items_at(std::vector<T> items, const std::vector<std::size_t>& kept) {
  if (kept.size() == items.size()) return items;
  std::vector<T> result;
  for (const std::size_t i : kept) result.push_back(std::move(items[i]));
  return result;
}

}  // namespace medial

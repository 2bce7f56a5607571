#pragma once

#include "medial/document.h"
#include "medial/error.h"

namespace medial {

/// An error that names an item of a document, in terms of the document's file.
template <class T>
Error in_file_of(const Document<T>& document, Error error) {
  if (auto& feature = error.place.feature) feature = document.index_of(*feature);
  return error;
}

}  // namespace medial

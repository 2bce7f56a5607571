#pragma once

// Checks of features as they are read.

#include <algorithm>
#include <functional>

#include "medial/io/read.h"

namespace medial::io {

/// Checks all features, or mends them. With `skip_invalid` those that fail are left out, with a
/// note each and one on all. Errors: those of `check`; empty.
Status check_each(Document<Feature>& document, bool skip_invalid,
                  const std::function<Status(Feature&, std::uint64_t index)>& check);

/// The note on a document of nothing.
constexpr const char* no_feature = "the file holds no feature";

/// Leaves out what is empty, not finite if it may be skipped, and counts what notes are made of.
/// The features of a file may come in several parts.
class FeatureChecks {
 public:
  explicit FeatureChecks(const ReadOptions& options) : options_(options) {}

  /// Errors: not_finite.
  Status check(Document<Feature>& part);
  /// Adds the notes on all parts. Errors: empty, where nothing is left of what was there.
  Status finish(Document<Feature>& document) const;

 private:
  const ReadOptions& options_;
  std::size_t before_ = 0, invalid_ = 0, empty_ = 0, left_ = 0, unclosed_ = 0;
};

}  // namespace medial::io

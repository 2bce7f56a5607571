#pragma once

// Random edits of shapes, and checks of an axis that follows them.

#include <cstdint>
#include <optional>
#include <string>

#include "medial/editor.h"
#include "support/generate.h"

namespace medial::test {

/// How the editor's axis differs from the one that is computed; empty where it does not. What the
/// certificate refuses of both is not the editor's fault.
std::string fault_of(const Editor& editor);

/// The kinds of random edits: of vertices alone, also of whole loops, or also of loops and bulges.
enum class EditKinds : std::uint8_t { vertices, loops, arcs };

/// A small shape, with holes or without; not of every seed a valid one.
Rings shape_to_edit(std::uint64_t seed, EditKinds kinds = EditKinds::vertices);

/// Random edits of one shape, some of them on the grid of the integers, where vertices come to lie
/// in a line with others and edges come to touch.
class Edits {
 public:
  explicit Edits(std::uint64_t seed, EditKinds kinds = EditKinds::vertices)
      : random_(seed), kinds_(kinds), on_grid_(seed % 3 == 0) {}
  /// Vertices have numbers below `vertices`, which grows where some are inserted.
  Result<AxisChange> next(Editor& editor, std::uint32_t& vertices);

 private:
  Result<AxisChange> of_loop(Editor& editor, std::uint32_t vertex, Vec2 way);
  Result<AxisChange> insert_loop(Editor& editor);
  Random random_;
  EditKinds kinds_;
  bool on_grid_;
};

/// What is wrong first while a seed's shape is edited so often, if anything.
std::optional<std::string> fault_of_edits(std::uint64_t seed, int count,
                                          EditKinds kinds = EditKinds::vertices);

}  // namespace medial::test

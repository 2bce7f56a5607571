#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inputs.h"
#include "measure.h"

namespace medial::bench {

/// What one input gave. A peer that was left out, or did not deliver, has a note instead.
struct Row {
  Input input;
  std::optional<MedialFigures> medial;
  std::optional<PeerFigures> boost;
  std::optional<PeerFigures> boost_unstretched;  ///< only where the coordinates allow it
  std::optional<PeerFigures> cgal;
  std::string medial_note;
  std::string boost_note;
  std::string cgal_note;
};

/// A Markdown table, one line an input; header_lines() are its first two.
std::string header_lines();
std::string line_of(const Row& row);
/// How the cost of a vertex grows from 1e4 vertices to 1e6, and the notes.
std::string summary_of(const std::vector<Row>& rows);
std::string json_of(const std::vector<Row>& rows);

}  // namespace medial::bench

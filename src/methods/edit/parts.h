#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial/editor.h"
#include "methods/edit/repair.h"
#include "methods/edit/rings.h"
#include "methods/edit/touching.h"
#include "methods/edit/weaver.h"
#include "methods/edit/window.h"

namespace medial::edit {

/// The effect of an edit, with the removed nodes and edges in the order of `change`.
struct Step {
  AxisChange change;
  std::vector<Disk> nodes;
  std::vector<AxisGraph::Edge> edges;
};

/// Merges a second change into a first one.
void join(AxisChange& first, const AxisChange& second);

/// The vertex that an edit reports: the first one if it is about a loop.
std::uint32_t subject_of(const Edit& edit);

/// Makes an error located at a vertex.
Error error_of(ErrorCode code, const char* text, std::uint32_t vertex);

/// Computes the axis of a shape's image in the local frame. Edges join as they do in the shape.
Result<MedialAxis> local_axis(const Shape& shape, const Options& options, double joint_tolerance);

}  // namespace medial::edit

namespace medial {

using edit::AxisGraph;
using edit::Rings;
using edit::Step;

/// The state of an editor. Sources: parts.cpp (computes the whole axis), follow.cpp (edits that are
/// followed), weave.cpp (edits after which other edges touch).
struct Editor::Parts {
  Options options;
  Box box;      ///< of the shape, including places where it was before
  Rings rings;  ///< the loops of the shape
  AxisGraph graph;
  edit::Measures measures;
  double tolerance = 0;  ///< in units of the input
  std::vector<edit::Edit> inverse;
  std::vector<std::uint32_t> marks;  ///< see Spread
  std::uint32_t mark = 0;
  std::optional<edit::Touching> touching;  ///< set if the edited rings differ from the loops

  /// The rings that are edited.
  const Rings& edited() const { return touching ? touching->rings() : rings; }
  Status start(const Shape& shape, bool is_first, bool touches);
  void set_rings(const Shape& shape, const LocalFrame& frame, const Rings::Joining& joining,
                 bool touches);
  Status start_again();
  Result<AxisChange> change(edit::Edit edit);
  Result<AxisChange> undo();

  static std::optional<Error> refuse(const edit::Edit& edit, const Rings& own);
  /// The sites from which the search for the affected part of the axis starts.
  struct Seeds {
    std::vector<Rings::Extent> before;  ///< sites that the edit can change
    std::vector<std::uint32_t> sites;
    int parts = 0;  ///< change of the number of parts less cycles: components less holes
    bool is_whole_part = false;
  };
  Seeds seeds_of(const edit::Edit& edit) const;
  void add_seeds_around(Vec2 place, Seeds& seeds) const;

  Result<std::optional<Step>> follow(const edit::Edit& edit, Rings::Verdict verdict);
  Result<std::optional<Step>> follow(const edit::Edit& edit, const edit::Edit& of_loops,
                                     Rings::Verdict verdict);
  edit::Detour detour_of(const edit::Edit& edit) const;
  bool straightens_crossing(const edit::Edit& edit) const;
  std::optional<Step> weave(const edit::Edit& edit, const edit::Contacts& contacts);
  std::optional<Step> weave(const edit::Contacts& contacts, edit::Weaver& weaver);
  std::optional<Step> weave_in_two(const edit::Edit& edit, const edit::Detour& way);
  void note(std::uint32_t of_rings, std::uint32_t of_loops, const std::vector<Vec2>& places);
  struct LoopWeave;
  std::optional<Step> weave_loops(const edit::Edit& edit, std::optional<Error>& refused);
  std::optional<Step> replace_loop(const edit::Edit& edit);
  Error refusal(const Rings::Judgement& judgement) const;
  std::optional<Step> follow(const edit::Edit& edit);
  std::optional<Step> follow_in_two(const edit::Edit& edit, std::optional<Error>& refused);
  Result<AxisChange> rebuild(const edit::Edit& edit);
  void refine(AxisChange& change);
  void set_box(const Box& other);
  bool fits_frame(const edit::Edit& edit) const;
  std::optional<Step> repair(const Seeds& seeds, const std::vector<Rings::Extent>& after,
                             std::uint32_t moved);
  std::optional<edit::Repair> repair(const std::vector<edit::Window>& windows,
                                     std::vector<std::uint32_t>& doubtful) const;
  std::optional<Step> repair_part(const edit::Edit& edit, const Seeds& seeds);
  std::optional<edit::Repair> axis_of_loops(const std::vector<std::uint32_t>& loops) const;
  std::optional<Step> replace(const edit::Affected& affected, const edit::Repair& repair,
                              int parts);
  void put_back(const Step& step);
  void list_all(std::vector<std::uint32_t>& nodes, std::vector<std::uint32_t>& edges) const;
  /// The corners of the loop of a vertex, starting at that vertex.
  std::vector<edit::Corner> corners_of(std::uint32_t vertex) const;
  Node node(std::uint32_t number) const;
  Edge edge(std::uint32_t number) const;
  Site site(std::uint32_t number) const;
};

}  // namespace medial

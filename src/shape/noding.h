#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/local_frame.h"
#include "base/predicates.h"
#include "base/quarter_map.h"
#include "medial/error.h"
#include "shape/clean.h"
#include "shape/sweep.h"

namespace medial {

/// An outline with arcs, ready for splice(): its edges are cut where they touch and where the sweep
/// line is tangent to them. Coordinates are local and rotated by a fixed angle, so that
/// configurations that are common in drawings (vertical tangents, vertices above each other) are
/// not special cases. Images of an outline under reflections and quarter turns have the same
/// coordinates, or these upside down.
struct NodedRings {
  CleanRings cleaned;                 ///< edges are monotone; sources name rings only
  std::vector<VertexSource> sources;  ///< of each vertex
  std::vector<Vec2> originals;        ///< of each vertex, in units of the input
  std::vector<double> edge_bulges;    ///< of each piece's edge
  std::vector<std::uint32_t> edges;   ///< of each piece
  std::vector<bool> passing;          ///< vertices that only the sweep needs
  std::vector<std::uint32_t> rings;   ///< of each ring of the outline: the ring of the input
  std::vector<EdgeWeight> weights;    ///< of each piece's edge
};

/// A contact of an edge with a vertex of the NodedRings, or (no_index) with a point in local
/// coordinates.
struct TouchedPoint {
  std::uint32_t edge = 0;
  std::uint32_t vertex = no_index;
  Vec2 point;
};

/// Two vertices of the NodedRings to merge.
struct Merge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// The edges of an outline while noding inserts vertices where they touch.
class Noding {
 public:
  /// `reach`, in units of the input, replaces the usual tolerance if it is larger.
  explicit Noding(const CleanRings& cleaned, double reach = 0);

  /// An error `unsupported` if the outline is so small relative to its coordinates that the
  /// tolerance cannot separate its edges.
  std::optional<Error> too_small() const;

  /// In local units.
  double tolerance() const { return tolerance_; }
  double tolerance_in_input() const { return tolerance_ / frame_.scale; }
  std::uint64_t split_edges() const { return split_edges_; }
  /// The vertex of the input at which the edge, or the edge that it is a part of, begins.
  VertexSource edge_source(std::uint32_t edge) const { return nodes_[edge].edge_source; }
  Vec2 to_input(Vec2 local) const;

  /// O(n).
  NodedRings monotone() const;

  /// Splits edges at contacts and merges vertices. Drops edges that become shorter than the
  /// tolerance. O(n + c log c). Error: no_area (a ring vanishes).
  std::optional<Error> apply(const NodedRings& noded, std::span<const TouchedPoint> contacts,
                             std::span<const Merge> merges);

  /// Drops edges of chains that repeat others within the tolerance, and adds their weights to the
  /// remaining edges. The edges before and after become separate chains. O(n log n). Returns the
  /// number of dropped edges.
  std::uint64_t drop_repeated();

 private:
  struct Node {
    Vec2 original;
    Vec2 local;
    double bulge = 0;
    VertexSource source;
    VertexSource edge_source;
    EdgeWeight weight;
  };

  /// A place at which an edge is cut.
  struct SplitPoint {
    std::uint32_t edge;
    double along;  ///< the chord
    Node node;
  };
  /// New places of points of the input. Follows chains of moves; the lowest point of a group stays.
  class Moves {
   public:
    Moves(const NodedRings& noded, std::span<const Merge> merges, const QuarterMap& map);
    Vec2 target(Vec2 point) const;

   private:
    struct Less {
      QuarterMap map;
      bool operator()(Vec2 a, Vec2 b) const {
        return lexicographic_less(map.to_image(a), map.to_image(b));
      }
    };
    Less less_;
    std::map<Vec2, Vec2, Less> moved_;
  };

  Vec2 to_local(Vec2 input) const;
  void move(Node& node, Vec2 original) const;
  /// The split points by edge, in order along it.
  std::vector<SplitPoint> split_points_of(const NodedRings& noded,
                                          std::span<const TouchedPoint> contacts,
                                          const Moves& moves) const;
  /// Appends the parts of the edge from node `v` to node `end`, except those of length 0.
  void append_parts(std::uint32_t v, std::uint32_t end, std::span<const SplitPoint> cuts,
                    const Moves& moves, std::vector<Node>& result);
  std::uint32_t next(std::uint32_t ring, std::uint32_t node) const {
    return node + 1 == begin_[ring + 1] ? begin_[ring] : node + 1;
  }
  bool ends_chain(std::uint32_t ring, std::uint32_t node) const {
    return open_ && node + 1 == begin_[ring + 1];
  }

  LocalFrame frame_;
  QuarterMap map_;
  double size_ = 0;       ///< the diagonal, in local units
  double tolerance_ = 0;  ///< in local units
  std::uint64_t split_edges_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> rings_;  ///< of each ring: that of the input
  bool open_ = false;                 ///< chains, see CleanRings
};

}  // namespace medial

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
/// line is tangent to them. Coordinates are local and turned by a fixed angle, so that what is
/// common in drawings (vertical tangents, vertices above each other) is not special here. Images of
/// an outline that are mirrored or turned by quarters have the same ones, or these upside down.
struct NodedRings {
  CleanRings cleaned;                 ///< edges are monotone; sources name rings only
  std::vector<VertexSource> sources;  ///< of each vertex
  std::vector<Vec2> originals;        ///< of each vertex, in units of the input
  std::vector<double> edge_bulges;    ///< of the edge that a piece is of
  std::vector<std::uint32_t> edges;   ///< the edge that a piece is of
  std::vector<bool> passing;          ///< vertices that are there for the sweep only
  std::vector<std::uint32_t> rings;   ///< of each ring of the outline, that of the input
  std::vector<EdgeWeight> weights;    ///< of the edge that a piece is of
};

/// An edge touches a point: a vertex of the NodedRings, or (no_index) a point in local
/// coordinates.
struct TouchedPoint {
  std::uint32_t edge = 0;
  std::uint32_t vertex = no_index;
  Vec2 point;
};

/// A vertex of the NodedRings is to become equal to another.
struct Merge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// The edges of an outline while vertices are put into them where they touch.
class Noding {
 public:
  /// `reach`, in units of the input, is the tolerance where it is larger than the usual one.
  explicit Noding(const CleanRings& cleaned, double reach = 0);

  /// An error `unsupported` where all of the outline is so small against its coordinates that the
  /// tolerance cannot tell its edges apart.
  std::optional<Error> too_small() const;

  /// In local units.
  double tolerance() const { return tolerance_; }
  double tolerance_in_input() const { return tolerance_ / frame_.scale; }
  std::uint64_t split_edges() const { return split_edges_; }
  /// The vertex of the input that the edge begins at, or that the edge it is a part of begins at.
  VertexSource edge_source(std::uint32_t edge) const { return nodes_[edge].edge_source; }
  Vec2 to_input(Vec2 local) const;

  /// O(n).
  NodedRings monotone() const;

  /// Splits edges at contacts and makes vertices equal. Edges that become shorter than the
  /// tolerance vanish. O(n + c log c). Error: no_area, if a ring vanishes.
  std::optional<Error> apply(const NodedRings& noded, std::span<const TouchedPoint> contacts,
                             std::span<const Merge> merges);

  /// Drops edges of chains that are there twice, to the tolerance, adding their weights to those
  /// that stay; the edges before and after become chains of their own. O(n log n). Returns how
  /// many.
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

  /// Where an edge is cut.
  struct SplitPoint {
    std::uint32_t edge;
    double along;  ///< the chord
    Node node;
  };
  /// Where points of the input move to. Chains are followed; the lowest of a group stays.
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
  /// By edge and along it.
  std::vector<SplitPoint> split_points_of(const NodedRings& noded,
                                          std::span<const TouchedPoint> contacts,
                                          const Moves& moves) const;
  /// Appends the parts of the edge from node `v` to node `end`, without those of no length.
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

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/path_builder.h"
#include "medial/io/read.h"

namespace medial::io {

/// $INSUNITS of a unit, 0 for those without; and back.
int dxf_units(Unit unit);
Unit unit_of_dxf(int units);

/// A block put somewhere: columns times rows of copies.
struct BlockCopies {
  std::string block;
  Vec2 place;
  double scale_x = 1, scale_y = 1;
  double angle = 0;  ///< in degrees
  int columns = 1, rows = 1;
  double column_step = 0, row_step = 0;
};

/// A drawing in DXF, entity by entity, as a library reads it: a build has dxflib for that, Python
/// has ezdxf. What follows begin_block() goes to that block, everything else to the drawing itself,
/// the block "".
class Drawing {
 public:
  struct Curve {
    std::string layer;
    Contour contour;
    bool closed = false;
  };
  struct Insert {
    std::string layer, block;
    Affine map;  ///< of the copy in column and row 0
    int columns = 1, rows = 1;
    Vec2 column_step, row_step;
  };
  struct Block {
    Vec2 base;
    std::vector<Curve> curves;
    std::vector<Insert> inserts;
  };
  Drawing() = default;
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  std::map<std::string, Block> blocks;
  std::set<std::string> layers, hidden;           ///< by the table of layers
  std::map<std::string, std::uint64_t> left_out;  ///< entities that are not read, by name
  int units = 0;                                  ///< $INSUNITS

  void begin_block(const std::string& name, Vec2 base);
  void end_block() { block_ = &blocks[""]; }

  /// What holds of the entity that is added next: its layer, and the normal of its plane. False,
  /// and the entity counts as left out, where that is not parallel to the drawing's.
  bool begin_entity(const std::string& name, std::string layer,
                    const std::array<double, 3>& normal);

  void add_point(Vec2 point);
  void add_line(Vec2 begin, Vec2 end);
  void add_circle(Vec2 center, double radius);
  void add_arc(Vec2 center, double radius, double begin, double end);  ///< in degrees
  /// In radians from the major half axis; the minor one is `ratio` times as long.
  void add_ellipse(Vec2 center, Vec2 major, double ratio, double begin, double end);
  /// With the bulge of the edge after each point.
  void add_polyline(const std::vector<Vec2>& points, const std::vector<double>& bulges,
                    bool closed);
  /// With a weight for each point. One without points is left out. Errors: malformed.
  Status add_spline(std::uint32_t degree, const std::vector<double>& knots,
                    const std::vector<Vec2>& points, const std::vector<double>& weights,
                    bool closed);
  void add_copies(const BlockCopies& copies);

 private:
  void keep(Contour contour, bool closed) {
    block_->curves.push_back({layer_, std::move(contour), closed});
  }
  /// What is given in the coordinates of the entity's own plane.
  void keep_in_plane(Contour contour, bool closed);

  Block* block_ = &blocks[""];
  std::string layer_;
  bool mirrored_ = false;  ///< seen from below
};

/// The closed curves of a drawing: a feature for each layer that has any, with the layer's name as
/// attribute, holes by the even-odd rule. Loose curves are joined (io/join.h); what stays open is
/// left out with a note. Hidden and frozen layers are left out, unless options.layer names one.
/// Errors: too_large (blocks that unfold to more than they may), unsupported (blocks nested too
/// deeply), empty, invalid_option (an unknown layer).
Result<Document<Feature>> features_of(const Drawing& drawing, const ReadOptions& options);

}  // namespace medial::io

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/arc.h"
#include "io/canvas.h"
#include "io/output.h"
#include "medial/io/carve.h"
#ifdef MEDIAL_DXF
#include "io/dxf_drawing.h"
#endif

namespace medial::io {

namespace {

constexpr char carve_formats[] = ".nc .gcode .ngc .csv .dxf .svg .pdf .png .ps";
constexpr std::array<const char*, 3> kind_names{"clearing", "wall", "groove"};

const char* name_of(ToolPathKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

/// Machines have y upwards.
ToolPoint upright(ToolPoint point, bool y_down) {
  if (y_down) point.point.y = -point.point.y, point.bulge = -point.bulge;
  return point;
}

/// A number without useless digits: "12.5", "-0.25", "0".
std::string number(double value) {
  std::string text = fmt::format("{:.6f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

class GCode {
 public:
  GCode(OutputStream& out, const MachineOptions& machine) : out_(out), machine_(machine) {}

  void begin() {
    line("(medial carve: millimetres, z 0 on the surface)");
    line("G21 G90 G17 G94");
    if (machine_.spindle > 0) line("M3 S" + number(machine_.spindle));
    line("G0 Z" + number(machine_.safe));
  }
  void end() {
    if (down_) lift();
    if (machine_.spindle > 0) line("M5");
    line("M2");
  }
  /// Goes to a place, down to its depth, and on; stays down where it is there already.
  void path(const std::vector<ToolPoint>& points, bool y_down) {
    const ToolPoint first = upright(points.front(), y_down);
    if (!down_ || !(first.point == at_.point) || first.z != at_.z) {
      if (down_) lift();
      line("G0 X" + number(first.point.x) + " Y" + number(first.point.y));
      line("G1 Z" + number(first.z) + " F" + number(machine_.plunge));
      feed_ = machine_.plunge;
      down_ = true;
    }
    at_ = first;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const ToolPoint to = upright(points[i], y_down);
      move(upright(points[i - 1], y_down).bulge, to);
      at_ = to;
    }
  }

 private:
  void line(const std::string& text) {
    out_.put(std::string_view(text));
    out_.put('\n');
  }
  void lift() {
    line("G0 Z" + number(machine_.safe));
    down_ = false;
  }
  void move(double bulge, const ToolPoint& to) {
    const std::string x = number(to.point.x), y = number(to.point.y), z = number(to.z);
    const bool same_place = x == number(at_.point.x) && y == number(at_.point.y);
    const bool same_height = z == number(at_.z);
    if (same_place && same_height && std::abs(bulge) < 1) return;
    std::string text;
    // An arc that six decimals hardly tell from its chord has no centre that they can tell.
    constexpr double shortest = 1e-3;
    if (bulge != 0 && distance(at_.point, to.point) > shortest) {
      const BulgeArc arc{at_.point, to.point, bulge};
      const Vec2 center = (1 / curvature(arc)) * left_of(start_tangent(arc));
      text = (bulge > 0 ? "G3 X" : "G2 X") + x + " Y" + y + " I" + number(center.x) + " J" +
             number(center.y);
    } else {
      text = "G1";
      if (!same_place) text += " X" + x + " Y" + y;
      if (!same_height) text += " Z" + z;
    }
    const double feed = same_place && to.z < at_.z ? machine_.plunge : machine_.feed;
    if (feed != feed_) text += " F" + number(feed);
    feed_ = feed;
    line(text);
  }

  OutputStream& out_;
  const MachineOptions& machine_;
  ToolPoint at_;
  bool down_ = false;
  double feed_ = 0;
};

void write_gcode(OutputStream& out, const Document<CarveItem>& file,
                 const MachineOptions& machine) {
  GCode program(out, machine);
  program.begin();
  for (const CarveItem& item : file.items)
    for (const ToolPath& path : item.carving.paths) program.path(path.points, file.y_down);
  program.end();
}

void write_csv(OutputStream& out, const Document<CarveItem>& file, const MachineOptions& machine) {
  out.put("path,kind,x,y,z\n");
  std::uint64_t id = 0;
  for (const CarveItem& item : file.items) {
    // Next to where offsets of two sides meet, a tangent may come nearer to the other side than its
    // arc does, by as much as it is away from that.
    constexpr double fine = 1e-6;
    const Carving& carving = item.carving;
    const double chord = machine.chord > 0
                             ? machine.chord
                             : fine * std::max(carving.tip_radius, carving.slope * carving.deepest);
    for (const ToolPath& path : item.carving.paths) {
      for (const ToolPoint& point : without_arcs(path, chord)) {
        out.put(id);
        out.put(',');
        out.put(std::string_view(name_of(path.kind)));
        for (const double value : {point.point.x, point.point.y, point.z}) {
          out.put(',');
          out.put(value);
        }
        out.put('\n');
      }
      ++id;
    }
  }
}

#ifdef MEDIAL_DXF
Status write_dxf(OutputStream& out, const Document<CarveItem>& file) {
  DxfDrawing drawing(out, {"CLEARING", "WALL", "GROOVE"});
  constexpr std::array<const char*, 3> layers{"CLEARING", "WALL", "GROOVE"};
  for (const CarveItem& item : file.items) {
    for (const ToolPath& path : item.carving.paths) {
      const std::string layer = layers[static_cast<std::size_t>(path.kind)];
      std::vector<Vec2> points;
      std::vector<double> bulges;
      bool level = true;
      for (const ToolPoint& own : path.points) {
        const ToolPoint point = upright(own, file.y_down);
        points.push_back(point.point);
        bulges.push_back(point.bulge);
        level = level && point.z == path.points.front().z;
      }
      if (level) {
        drawing.polyline(layer, points, bulges, false, path.points.front().z);
        continue;
      }
      drawing.begin_entity(layer, "POLYLINE", "AcDb3dPolyline");
      DxfGroups& groups = drawing.groups();
      groups.dxfInt(66, 1);
      groups.coord(10, 0, 0, 0);
      groups.dxfInt(70, 8);
      for (std::size_t i = 0; i < points.size(); ++i) {
        drawing.begin_entity(layer, "VERTEX", "AcDbVertex");
        groups.dxfString(100, "AcDb3dPolylineVertex");
        groups.coord(10, points[i].x, points[i].y, path.points[i].z);
        groups.dxfInt(70, 32);
      }
      groups.entity("SEQEND");
      groups.dxfString(100, "AcDbEntity");
      groups.dxfString(8, layer);
    }
  }
  return drawing.finish();
}
#endif

/// A path in the plane; its last bulge is 0.
Ring line_of(const ToolPath& path) {
  Ring line;
  for (const ToolPoint& point : path.points) {
    line.points.push_back(point.point);
    line.bulges.push_back(point.bulge);
  }
  return line;
}

/// The cut from above, the deeper the darker, level by level; then the paths, and the ways through
/// the air.
Status write_picture(OutputStream& out, const std::string& format, const Document<CarveItem>& file,
                     const WriteOptions& options) {
  Extent extent;
  double deepest = 0;
  for (const CarveItem& item : file.items) {
    extent.add(item.shape);
    deepest = std::max(deepest, item.carving.deepest);
  }
  return write_canvas(out, format, extent.box(), options.width, file.y_down, [&](Canvas& canvas) {
    constexpr Color wood{0.93, 0.86, 0.74}, bottom{0.36, 0.22, 0.12}, outline{0.25, 0.25, 0.3};
    const int levels = format == "png" ? 32 : 12;
    for (const CarveItem& item : file.items) {
      const Carving& carving = item.carving;
      std::vector<std::vector<const ToolPath*>> walls;  // of each pass
      for (const ToolPath& path : carving.paths) {
        if (path.kind != ToolPathKind::wall) continue;
        walls.resize(std::max<std::size_t>(walls.size(), path.pass + 1));
        walls[path.pass].push_back(&path);
      }
      // What is deeper than a level: flat bottoms within their walls, and around each path as much
      // as the cone is wide there.
      for (int level = 0; level < levels; ++level) {
        const double depth = deepest * level / levels, t = (level + 0.5) / levels;
        canvas.color({wood.red + t * (bottom.red - wood.red),
                      wood.green + t * (bottom.green - wood.green),
                      wood.blue + t * (bottom.blue - wood.blue)});
        for (const auto& of_pass : walls) {
          for (const ToolPath* wall : of_pass)
            if (-wall->points.front().z > depth) canvas.trace(line_of(*wall));
          canvas.fill_even_odd();
        }
        for (const ToolPath& path : carving.paths) {
          const double over = -path.points.front().z - depth;
          if (path.kind != ToolPathKind::wall || !(over > 0)) continue;
          canvas.width_in_units(2 * (carving.tip_radius + carving.slope * over));
          canvas.trace(line_of(path), false);
          canvas.stroke();
        }
        for (const ToolPath& path : carving.paths) {
          if (path.kind != ToolPathKind::groove) continue;
          for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
            const ToolPoint &from = path.points[i], &to = path.points[i + 1];
            const double over0 = -from.z - depth, over1 = -to.z - depth;
            if (!(over0 > 0 || over1 > 0)) continue;
            const double wide0 = over0 >= 0 ? carving.tip_radius + carving.slope * over0 : 0;
            const double wide1 = over1 >= 0 ? carving.tip_radius + carving.slope * over1 : 0;
            // Where the move rises through the level the cut ends before it does.
            const double share0 = over0 < 0 ? over0 / (over0 - over1) : 0;
            const double share1 = over1 < 0 ? over0 / (over0 - over1) : 1;
            canvas.tapered(from.point + share0 * (to.point - from.point), wide0,
                           from.point + share1 * (to.point - from.point), wide1);
          }
        }
        canvas.fill();
      }
      canvas.line_width(0.8);
      for (const ToolPath& path : carving.paths) {
        canvas.color(
            path.kind == ToolPathKind::groove ? Color{0.95, 0.95, 1.0} : Color{0.55, 0.8, 0.95},
            path.kind == ToolPathKind::clearing ? 0.5 : 0.9);
        canvas.trace(line_of(path), false);
        canvas.stroke();
      }
      canvas.color({0.85, 0.2, 0.2}, 0.8);
      canvas.line_width(0.6);
      for (std::size_t k = 0; k + 1 < carving.paths.size(); ++k) {
        const std::array<Vec2, 2> way{carving.paths[k].points.back().point,
                                      carving.paths[k + 1].points.front().point};
        canvas.trace(std::span<const Vec2>(way));
        canvas.stroke();
      }
      canvas.color(outline);
      canvas.line_width(1.2);
      canvas.trace(item.shape);
      canvas.stroke();
    }
  });
}

}  // namespace

std::string known_carve_formats() { return carve_formats; }

Status write_carving(const std::string& path, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine,
                     const WriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "nc", carve_formats);
  if (!known) return known.error();
  for (const double value : {machine.safe, machine.feed, machine.plunge})
    if (!(value > 0) || !std::isfinite(value) || !(machine.chord >= 0))
      return Error{ErrorCode::invalid_option, "heights, feeds and chords must be positive", {}};
  return write_whole(path, [&](OutputStream& out) -> Status {
    if (*known == "dxf") {
#ifdef MEDIAL_DXF
      return write_dxf(out, file);
#else
      return Error{ErrorCode::unsupported, "this program was built without DXF", {}};
#endif
    }
    if (*known == "csv") {
      write_csv(out, file, machine);
    } else if (*known == "nc" || *known == "gcode" || *known == "ngc") {
      write_gcode(out, file, machine);
    } else {
      return write_picture(out, *known, file, options);
    }
    return success();
  });
}

}  // namespace medial::io

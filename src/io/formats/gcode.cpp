// Plain G-code.

#include <fmt/format.h>

#include <cmath>

#include "base/arc.h"
#include "io/format.h"
#include "io/tool_paths.h"

namespace medial::io {

namespace {

/// A number without useless digits: "12.5", "-0.25", "0".
std::string decimal(double value) {
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
    if (machine_.spindle > 0) line("M3 S" + decimal(machine_.spindle));
    line("G0 Z" + decimal(machine_.safe));
  }
  void end() {
    if (down_) lift();
    if (machine_.spindle > 0) line("M5");
    line("M2");
  }
  /// Goes to a place, down to its depth, and on; stays down where it is there already.
  void path(const std::vector<ToolPoint>& points) {
    const ToolPoint& first = points.front();
    if (!down_ || !(first.point == at_.point) || first.z != at_.z) {
      if (down_) lift();
      line("G0 X" + decimal(first.point.x) + " Y" + decimal(first.point.y));
      line("G1 Z" + decimal(first.z) + " F" + decimal(machine_.plunge));
      feed_ = machine_.plunge;
      down_ = true;
    }
    at_ = first;
    for (std::size_t i = 1; i < points.size(); ++i) {
      move(points[i - 1].bulge, points[i]);
      at_ = points[i];
    }
  }

 private:
  void line(const std::string& text) {
    out_.put(std::string_view(text));
    out_.put('\n');
  }
  void lift() {
    line("G0 Z" + decimal(machine_.safe));
    down_ = false;
  }
  void move(double bulge, const ToolPoint& to) {
    const std::string x = decimal(to.point.x), y = decimal(to.point.y), z = decimal(to.z);
    const bool same_place = x == decimal(at_.point.x) && y == decimal(at_.point.y);
    const bool same_height = z == decimal(at_.z);
    if (same_place && same_height && std::abs(bulge) < 1) return;
    std::string text;
    // Six decimals do not hold the centre of an arc that is hardly longer than they resolve.
    constexpr double shortest = 1e-3;
    if (bulge != 0 && distance(at_.point, to.point) > shortest) {
      const BulgeArc arc{at_.point, to.point, bulge};
      const Vec2 center = (1 / curvature(arc)) * left_of(start_tangent(arc));
      text = (bulge > 0 ? "G3 X" : "G2 X") + x + " Y" + y + " I" + decimal(center.x) + " J" +
             decimal(center.y);
    } else {
      text = "G1";
      if (!same_place) text += " X" + x + " Y" + y;
      if (!same_height) text += " Z" + z;
    }
    const double feed = same_place && to.z < at_.z ? machine_.plunge : machine_.feed;
    if (feed != feed_) text += " F" + decimal(feed);
    feed_ = feed;
    line(text);
  }

  OutputStream& out_;
  const MachineOptions& machine_;
  ToolPoint at_;
  bool down_ = false;
  double feed_ = 0;
};

Status write_gcode(Target& target, const CarvingOutput& output) {
  GCode program(*target.out, output.machine);
  program.begin();
  for (const CarveItem& item : output.document.items)
    for (const ToolPath& path : item.carving.paths)
      program.path(upright_path(path, output.document.y_down));
  program.end();
  return success();
}

}  // namespace

const char* name_of(ToolPathKind kind) {
  constexpr std::array<const char*, 3> names{"clearing", "wall", "groove"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<ToolPoint> upright_path(const ToolPath& path, bool y_down) {
  std::vector<ToolPoint> points = path.points;
  if (!y_down) return points;
  for (ToolPoint& point : points) {
    point.point.y = -point.point.y;
    point.bulge = -point.bulge;
  }
  return points;
}

Ring line_of(const std::vector<ToolPoint>& points) {
  Ring line;
  for (const ToolPoint& point : points) {
    line.points.push_back(point.point);
    line.bulges.push_back(point.bulge);
  }
  return line;
}

Format gcode_format() { return Format{".nc .gcode .ngc"}.writes<CarvingOutput>(write_gcode); }

}  // namespace medial::io

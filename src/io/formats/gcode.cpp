// G-code.

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "base/arc.h"
#include "io/format.h"
#include "io/formats/gcode_posts.h"
#include "io/tool_paths.h"
#include "medial/document.h"

namespace medial::io {

namespace {

/// In millionths, rounded as printf() does: exactly, and to even where two are as near.
double millionths(double value) {
  const double scaled = 1e6 * value, rest = std::fma(1e6, value, -scaled);
  const double whole = std::nearbyint(scaled), off = scaled - whole;
  if (off == 0.5 && rest > 0) return whole + 1;
  if (off == -0.5 && rest < 0) return whole - 1;
  return whole;
}

/// A number without useless digits: "12.5", "-0.25", "0".
std::string decimal(double value) {
  constexpr double exact = 0x1p52;
  constexpr std::uint64_t million = 1'000'000;
  const double whole = millionths(value);
  if (!(std::abs(whole) < exact)) {
    std::string text = fmt::format(FMT_COMPILE("{:.6f}"), value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
  }
  std::array<char, 32> text;
  char* end = text.data();
  if (whole < 0) *end++ = '-';
  const auto size = static_cast<std::uint64_t>(std::abs(whole));
  end = std::to_chars(end, text.data() + text.size(), size / million).ptr;
  if (std::uint64_t rest = size % million; rest != 0) {
    *end = '.';
    for (int k = 6; k > 0; --k, rest /= 10) end[k] = static_cast<char>('0' + rest % 10);
    end += 7;
    while (end[-1] == '0') --end;
  }
  return {text.data(), end};
}

/// A place as it is written.
struct PlaceText {
  explicit PlaceText(const ToolPoint& place)
      : x(decimal(place.point.x)), y(decimal(place.point.y)), z(decimal(place.z)) {}
  PlaceText() : PlaceText(ToolPoint{}) {}
  std::string x, y, z;
};

/// Moves of one tool after another, with what they add up to.
class Moves {
 public:
  explicit Moves(const MachineOptions& machine) : machine_(machine) {
    report_.box = Box::nothing();
  }

  void use(const CuttingSpeeds& speeds) { speeds_ = speeds; }
  /// Makes room for the lines of so many points, so that they are hardly ever copied.
  void expect(std::size_t points) { text_.reserve(text_.size() + usual_line * points); }
  /// Goes to a place, down to its depth, and on; stays down where it is there already.
  void path(const std::vector<ToolPoint>& points) {
    const ToolPoint& first = points.front();
    if (!down_ || !(first.point == at_.point) || first.z != at_.z) {
      lift();
      line({"G0 X", decimal(first.point.x), " Y", decimal(first.point.y)});
      spend(started_ ? distance(at_.point, first.point) : 0, machine_.rapid, report_.travel);
      line({"G1 Z", decimal(first.z), " F", decimal(speeds_.plunge)});
      spend(machine_.safe - first.z, speeds_.plunge, vertical_);
      feed_ = speeds_.plunge;
      down_ = started_ = true;
    }
    arrive(first, PlaceText(first));
    for (std::size_t i = 1; i < points.size(); ++i) {
      PlaceText text(points[i]);
      move(points[i - 1].bulge, points[i], text);
      arrive(points[i], std::move(text));
    }
  }
  void lift() {
    if (!down_) return;
    line({"G0 Z", decimal(machine_.safe)});
    spend(machine_.safe - at_.z, machine_.rapid, vertical_);
    down_ = false;
  }
  /// The lines so far, which are taken away.
  std::string take() { return std::exchange(text_, {}); }
  const CutReport& report() const { return report_; }

 private:
  void add(std::initializer_list<std::string_view> texts) {
    for (const std::string_view text : texts) text_ += text;
  }
  void line(std::initializer_list<std::string_view> texts) {
    add(texts);
    text_ += '\n';
  }
  void arrive(const ToolPoint& place, PlaceText text) {
    at_ = place;
    at_text_ = std::move(text);
    report_.box.add(at_.point);
    report_.lowest = std::min(report_.lowest, at_.z);
  }
  void spend(double way, double speed, double& sum) {
    constexpr double minute = 60;
    sum += way;
    report_.seconds += minute * way / speed;
  }
  void move(double bulge, const ToolPoint& to, const PlaceText& to_text) {
    const auto& [x, y, z] = to_text;
    const bool same_place = x == at_text_.x && y == at_text_.y;
    const bool same_height = z == at_text_.z;
    if (same_place && same_height && std::abs(bulge) < 1) return;
    // Six decimals do not hold the centre of an arc that is hardly longer than they resolve.
    constexpr double shortest = 1e-3;
    if (bulge != 0 && distance(at_.point, to.point) > shortest) {
      const BulgeArc arc{at_.point, to.point, bulge};
      const Vec2 center = (1 / curvature(arc)) * left_of(start_tangent(arc));
      add({bulge > 0 ? "G3 X" : "G2 X", x, " Y", y, " I", decimal(center.x), " J",
           decimal(center.y)});
      add_extent(arc);
    } else {
      add({"G1"});
      if (!same_place) add({" X", x, " Y", y});
      if (!same_height) add({" Z", z});
    }
    const double feed = same_place && to.z < at_.z ? speeds_.plunge : speeds_.feed;
    if (feed != feed_) add({" F", decimal(feed)});
    feed_ = feed;
    line({});
    ++report_.moves;
    const double flat = arc_length(distance(at_.point, to.point), bulge);
    spend(std::hypot(flat, to.z - at_.z), feed, report_.cut);
  }
  void add_extent(const BulgeArc& arc) {
    for (const Vec2 side : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}})
      if (const auto point = parallel_point(arc, side)) report_.box.add(*point);
  }

  static constexpr std::size_t usual_line = 40;  // of "G1 X141.424932 Y-5.6404 Z-2.647182"

  const MachineOptions& machine_;
  CuttingSpeeds speeds_;
  std::string text_;
  CutReport report_;
  double vertical_ = 0;
  ToolPoint at_;
  PlaceText at_text_;
  bool down_ = false, started_ = false;
  double feed_ = 0;
};

/// Describes the tool of a carving.
std::string description_of(const Carving& carving, const std::string& unit) {
  if (carving.slope == 0)
    return fmt::format("end mill, diameter {} {}", decimal(2 * carving.tip_radius), unit);
  constexpr double degrees = 180 / std::numbers::pi;
  std::string text =
      fmt::format("V of {} degrees", decimal(2 * degrees * std::atan(carving.slope)));
  if (carving.tip_radius > 0)
    text += fmt::format(", tip {} {}", decimal(2 * carving.tip_radius), unit);
  return text;
}

/// One tool at work.
struct Section {
  std::string description, moves;
  double deepest = 0;
  std::uint32_t passes = 0;
  CuttingSpeeds speeds;
};

struct Program {
  std::vector<Section> sections;  ///< in the order of cutting
  CutReport report;
};

Program program_of(const Document<CarveItem>& file, const MachineOptions& machine) {
  Program program;
  Moves moves(machine);
  double own = 0;
  const auto add = [&](Carving CarveItem::*carving, const CuttingSpeeds& speeds) {
    Section section{{}, {}, 0, 0, speeds};
    moves.use(speeds);
    std::size_t points = 0;
    for (const CarveItem& item : file.items)
      for (const ToolPath& path : (item.*carving).paths) points += path.points.size();
    moves.expect(points);
    for (const CarveItem& item : file.items) {
      const Carving& one = item.*carving;
      if (one.paths.empty()) continue;
      section.description = description_of(one, name_of(file.unit));
      section.deepest = std::max(section.deepest, one.deepest);
      section.passes = std::max(section.passes, one.passes);
      own += one.own_length;
      for (const ToolPath& path : one.paths) moves.path(path.points);
    }
    moves.lift();
    section.moves = moves.take();
    if (!section.moves.empty()) program.sections.push_back(std::move(section));
  };
  add(&CarveItem::clearing, machine.clearing);
  add(&CarveItem::carving, machine.carving);
  program.report = moves.report();
  program.report.own = own;
  if (program.report.box.is_nothing()) program.report.box = {};
  return program;
}

std::string header_of(const Program& program, const std::string& name, Unit unit, double safe) {
  const CutReport& report = program.report;
  const Box& box = report.box;
  std::string text = fmt::format("(medial carve: {})\n", comment_of(name));
  text += fmt::format("(units: {}, z 0 on the surface)\n", unit == Unit::inch ? "inches" : "mm");
  int number = 0;
  for (const Section& section : program.sections)
    text += fmt::format(
        "(tool {}: {}, depth {} in {})\n", ++number, section.description, decimal(section.deepest),
        section.passes == 1 ? "one pass" : fmt::format("{} passes", section.passes));
  text += fmt::format("(bounds: X {} to {}, Y {} to {}, Z {} to {})\n", decimal(box.low.x),
                      decimal(box.high.x), decimal(box.low.y), decimal(box.high.y),
                      decimal(report.lowest), decimal(safe));
  const auto seconds = static_cast<std::int64_t>(std::ceil(report.seconds));
  text += fmt::format("(cut {:.6g}, travel {:.6g}, about {} min {} s)", report.cut, report.travel,
                      seconds / 60, seconds % 60);
  return text;
}

Status write_gcode(Target& target, const CarvingOutput& output) {
  const MachineOptions& machine = output.machine;
  const Document<CarveItem>& file = output.document;
  const bool inches = file.unit == Unit::inch;
  const Program program = program_of(file, machine);
  auto post = PostTemplate::make(machine.post);
  if (!post) return std::move(post).error();
  PostValues values{{"header", header_of(program, target.name, file.unit, machine.safe)},
                    {"units", inches ? "G20" : "G21"},
                    {"tolerance", inches ? "0.0004" : "0.01"},
                    {"safe", decimal(machine.safe)},
                    {"stop", ""}};
  const auto put = [&](PostPart part) {
    target.out->put(std::string_view(post->fill(part, values)));
  };
  put(PostPart::start);
  int number = 0;
  for (const Section& section : program.sections) {
    values["tool"] = std::to_string(++number);
    values["description"] = section.description;
    values["spindle"] = section.speeds.spindle > 0 ? "M3 S" + decimal(section.speeds.spindle) : "";
    values["stop"] = section.speeds.spindle > 0 ? "M5" : "";
    if (program.sections.size() > 1) put(PostPart::tool);
    put(PostPart::cut);
    target.out->put(std::string_view(section.moves));
  }
  put(PostPart::end);
  return success();
}

}  // namespace

CutReport report_of(const Document<CarveItem>& file, const MachineOptions& machine) {
  return program_of(file, machine).report;
}

const char* name_of(ToolPathKind kind) {
  constexpr std::array<const char*, 5> names{"clearing", "wall", "groove", "ramp", "plunge"};
  return names[static_cast<std::size_t>(kind)];
}

Ring line_of(const std::vector<ToolPoint>& points) {
  Ring line;
  for (const ToolPoint& point : points) {
    line.points.push_back(point.point);
    line.bulges.push_back(point.bulge);
  }
  return line;
}

void place(Document<CarveItem>& file, Vec2 zero) {
  const double up = file.y_down ? -1 : 1;
  for (CarveItem& item : file.items) {
    for (Vec2& p : item.shape.points) p = {p.x - zero.x, up * (p.y - zero.y)};
    for (double& bulge : item.shape.bulges) bulge *= up;
    item.carving = placed(std::move(item.carving), zero, file.y_down);
    item.clearing = placed(std::move(item.clearing), zero, file.y_down);
  }
  file.y_down = false;
}

Format gcode_format() {
  return Format{".nc .gcode .ngc .tap .cnc"}.writes<CarvingOutput>(write_gcode);
}

}  // namespace medial::io

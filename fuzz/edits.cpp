// Bytes to a shape and edits of it, for libFuzzer: `make fuzz-coverage`.
//
// After each edit that is accepted, the shape is the one that build_shape() makes of the edited
// rings, and the axis that of compute(). One that is refused changes nothing, its error is one that
// medial/editor.h names, and build_shape() or compute() refuses the edited rings as well. To undo
// an edit brings the shape back as it was.

#include "tests/support/edits.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/arc.h"
#include "bytes.h"
#include "medial/medial.h"
#include "tests/support/same_graph.h"

namespace medial::fuzz {
namespace {

std::vector<Ring> first_rings(Bytes& bytes) {
  const std::uint8_t what = bytes.byte();
  const Ring circle{{{-8, 0}, {8, 0}}, RingRole::any, {1, 1}};
  const Ring island{{{-2, 0}, {2, 0}}, RingRole::any, {0.5, 1}};
  switch (what % 8) {
    case 0:
      return test::comb(3 + what / 32);
    case 1:
      return test::hole_grid(2);
    case 2:
      return {circle, island};
    case 3:
      return test::nested_squares(3);
    case 4:
      return test::regular_polygon(3 + what / 8, 10);
    case 5:
      return test::jagged_star(16);
    default: {
      constexpr std::size_t most = 40;
      return rings_from(bytes, what % 8 == 6, bytes.byte() % most);
    }
  }
}

/// Loops in an order that says nothing.
struct Outline {
  std::vector<std::array<double, 3>> corners;  ///< place and bulge
  bool hole = false;
  auto operator<=>(const Outline&) const = default;
};
std::vector<Outline> outlines_of(const Shape& shape) {
  std::vector<Outline> outlines;
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    Outline& outline = outlines.emplace_back();
    outline.hole = shape.hole[l];
    for (std::uint32_t i = shape.loop_begin[l]; i < shape.loop_begin[l + 1]; ++i)
      outline.corners.push_back({shape.points[i].x, shape.points[i].y, shape.bulge(i)});
    std::vector<std::array<double, 3>> turned = outline.corners;
    for (std::size_t i = 0; i + 1 < turned.size(); ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      outline.corners = std::min(outline.corners, turned);
    }
  }
  std::sort(outlines.begin(), outlines.end());
  return outlines;
}

/// The rings of an editor's shape with the numbers of their vertices, to be edited by hand.
struct Drawing {
  struct Corner {
    std::uint32_t number;
    Vec2 point;
    double bulge;
  };
  struct Loop {
    std::vector<Corner> corners;
    RingRole role;
  };
  std::vector<Loop> loops;

  explicit Drawing(const Shape& shape) {
    for (std::size_t l = 0; l < shape.loop_count(); ++l) {
      Loop& loop = loops.emplace_back();
      loop.role = shape.hole[l] ? RingRole::hole : RingRole::outer;
      for (std::uint32_t i = shape.loop_begin[l]; i < shape.loop_begin[l + 1]; ++i)
        loop.corners.push_back({shape.sources[i].vertex, shape.points[i], shape.bulge(i)});
    }
  }
  /// The loop that a vertex lies on, turned so that it is the first one.
  Loop& loop_from(std::uint32_t vertex) {
    for (Loop& loop : loops) {
      const auto place =
          std::find_if(loop.corners.begin(), loop.corners.end(),
                       [&](const Corner& corner) { return corner.number == vertex; });
      if (place == loop.corners.end()) continue;
      std::rotate(loop.corners.begin(), place, loop.corners.end());
      return loop;
    }
    return loops.front();
  }
  std::vector<Ring> rings() const {
    std::vector<Ring> rings;
    for (const Loop& loop : loops) {
      Ring& ring = rings.emplace_back();
      ring.role = loop.role;
      for (const Corner& corner : loop.corners) {
        ring.points.push_back(corner.point);
        ring.bulges.push_back(corner.bulge);
      }
    }
    const auto is_straight = [](double bulge) { return bulge == 0; };
    for (Ring& ring : rings)
      if (std::all_of(ring.bulges.begin(), ring.bulges.end(), is_straight)) ring.bulges.clear();
    return rings;
  }
};

enum class Kind : std::uint8_t { move, insert, remove, bend, insert_loop, remove_loop, move_loop };
struct Edit {
  Kind kind = Kind::move;
  std::uint32_t vertex = 0;
  Vec2 place;  ///< of move_loop the way
  double bulge = 0;
  Ring ring = {};
};

Result<AxisChange> make(const Edit& edit, Editor& editor) {
  switch (edit.kind) {
    case Kind::move:
      return editor.move(edit.vertex, edit.place);
    case Kind::insert:
      return editor.insert(edit.vertex, edit.place);
    case Kind::remove:
      return editor.remove(edit.vertex);
    case Kind::bend:
      return editor.set_bulge(edit.vertex, edit.bulge);
    case Kind::insert_loop:
      return editor.insert_loop(edit.ring);
    case Kind::remove_loop:
      return editor.remove_loop(edit.vertex);
    case Kind::move_loop:
      return editor.move_loop(edit.vertex, edit.place);
  }
  return AxisChange{};
}

/// The same edit of rings.
void make(const Edit& edit, Drawing& drawing) {
  if (edit.kind == Kind::insert_loop) {
    Drawing::Loop& loop = drawing.loops.emplace_back();
    loop.role = RingRole::hole;
    for (std::size_t i = 0; i < edit.ring.points.size(); ++i)
      loop.corners.push_back(
          {~0U, edit.ring.points[i], edit.ring.bulges.empty() ? 0 : edit.ring.bulges[i]});
    return;
  }
  Drawing::Loop& loop = drawing.loop_from(edit.vertex);
  Drawing::Corner& own = loop.corners[0];
  switch (edit.kind) {
    case Kind::move:
      own.point = edit.place;
      break;
    case Kind::insert: {
      const Vec2 start = own.point, end = loop.corners[1 % loop.corners.size()].point;
      std::array<double, 2> bulges{};
      if (own.bulge != 0)
        bulges = {std::tan(0.5 * signed_angle(end - start, end - edit.place)),
                  std::tan(0.5 * signed_angle(edit.place - start, end - start))};
      own.bulge = bulges[0];
      loop.corners.insert(loop.corners.begin() + 1, {~0U, edit.place, bulges[1]});
      break;
    }
    case Kind::remove: {
      const double both = std::atan(loop.corners.back().bulge) + std::atan(own.bulge);
      loop.corners.back().bulge = std::abs(both) < 0.5 * std::numbers::pi ? std::tan(both) : 0;
      loop.corners.erase(loop.corners.begin());
      break;
    }
    case Kind::bend:
      own.bulge = edit.bulge;
      break;
    case Kind::remove_loop:
      loop.corners.clear();
      drawing.loops.erase(
          std::find_if(drawing.loops.begin(), drawing.loops.end(),
                       [](const Drawing::Loop& one) { return one.corners.empty(); }));
      break;
    case Kind::move_loop:
      for (Drawing::Corner& corner : loop.corners) corner.point = corner.point + edit.place;
      break;
    case Kind::insert_loop:
      break;
  }
}

/// The shape that an edit should lead to. A loop that comes or moves is a hole or not by its place.
Result<Shape> expected_of(const Edit& edit, const Shape& before) {
  Drawing drawing(before);
  make(edit, drawing);
  auto shape = build_shape(drawing.rings());
  if (shape || (edit.kind != Kind::insert_loop && edit.kind != Kind::move_loop)) return shape;
  RingRole& role = edit.kind == Kind::insert_loop ? drawing.loops.back().role
                                                  : drawing.loop_from(edit.vertex).role;
  role = role == RingRole::hole ? RingRole::outer : RingRole::hole;
  return build_shape(drawing.rings());
}

/// Whether an editor's shape has all of its vertices, so many, as they are, and no two in one
/// place: elsewhere edges touch or join, and the loops that are edited are others.
bool shows_all(const Editor& editor, const Shape& shape, std::size_t count) {
  std::set<std::pair<double, double>> places;
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const std::uint32_t number = shape.sources[i].vertex;
    places.emplace(shape.points[i].x, shape.points[i].y);
    numbers.insert(number);
    if (editor.vertex(number) != shape.points[i] || editor.bulge(number) != shape.bulge(i))
      return false;
  }
  return shape.points.size() == count && places.size() == count && numbers.size() == count;
}

bool is_named(ErrorCode code) {
  constexpr std::array codes{
      ErrorCode::crossing,       ErrorCode::not_finite,   ErrorCode::too_few_points,
      ErrorCode::invalid_option, ErrorCode::no_area,      ErrorCode::overlap,
      ErrorCode::hole_outside,   ErrorCode::nested_outer, ErrorCode::too_large,
      ErrorCode::empty,          ErrorCode::unsupported};
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

class Session {
 public:
  Session(Bytes& bytes, Editor editor)
      : bytes_(bytes), editor_(std::move(editor)), first_(editor_.shape()) {
    for (std::uint32_t i = 0; editor_.node(i); ++i) nodes_.insert(i);
    for (std::uint32_t i = 0; editor_.edge(i); ++i) edges_.insert(i);
    vertices_ = static_cast<std::uint32_t>(first_.points.size());
    check_axis();
  }

  void run() {
    constexpr int most_edits = 24;
    constexpr std::size_t most_points = 80;
    for (int i = 0; i < most_edits && !bytes_.done(); ++i) {
      const std::uint8_t what = bytes_.byte() % 16;
      constexpr std::uint8_t kinds = 7;  // of edits, and more of moves
      if (what < kinds)
        edit(edit_of(static_cast<Kind>(what)));
      else if (what == kinds)
        undo();
      else if (what == kinds + 1)
        keep();
      else if (what == kinds + 2 && kept_)
        take_back(*kept_);
      else
        edit(edit_of(Kind::move));
      if (editor_.shape().points.size() > most_points) break;
    }
    while (!earlier_.empty()) undo();
    if (outlines_of(editor_.shape()) != outlines_of(first_)) complain("not as in the beginning");
  }

 private:
  struct Kept {
    explicit Kept(const Session& session)
        : editor(session.editor_),
          earlier(session.earlier_),
          nodes(session.nodes_),
          edges(session.edges_),
          vertices(session.vertices_) {}
    Editor editor;
    std::vector<std::vector<Outline>> earlier;
    std::set<std::uint32_t> nodes, edges;
    std::uint32_t vertices;
  };

  void keep() {
    log_ += "keep\n";
    kept_.emplace(*this);
  }
  void take_back(const Kept& kept) {
    log_ += "as it was kept\n";
    editor_ = kept.editor;
    earlier_ = kept.earlier;
    nodes_ = kept.nodes;
    edges_ = kept.edges;
    vertices_ = kept.vertices;
  }

  [[noreturn]] void complain(const std::string& what) {
    std::fprintf(stderr, "the first shape:\n");
    print(rings_of(first_));
    std::fprintf(stderr, "edits:\n%snow:\n", log_.c_str());
    fail(what.c_str(), rings_of(editor_.shape()));
  }

  std::uint32_t vertex() {
    const std::uint8_t byte = bytes_.byte();
    if (byte == 255) return ~std::uint32_t{0} - bytes_.byte() % 2;
    if (byte == 254) return vertices_ + bytes_.byte();
    std::uint32_t v = byte % vertices_;
    for (std::uint32_t i = 0; i < vertices_ && !editor_.vertex(v); ++i) v = (v + 1) % vertices_;
    return v;
  }

  Vec2 place() {
    std::vector<Vec2> places;
    for (std::uint32_t v = 0; v < vertices_; ++v)
      if (const auto p = editor_.vertex(v)) places.push_back(*p);
    const std::uint8_t kind = bytes_.byte() % 8;
    if (kind < 3) return point_from(bytes_, kind, places);
    const Vec2 from = places[bytes_.byte() % places.size()],
               to = places[bytes_.byte() % places.size()];
    if (kind < 5) return from + bytes_.small() / 64 * (to - from);
    const double scale = distance(from, to) * std::ldexp(1, -(bytes_.byte() % 64));
    const double x = bytes_.small();
    return from + scale * Vec2{x, bytes_.small()};
  }

  double bulge() {
    constexpr double full = 127;
    const std::uint8_t kind = bytes_.byte() % 8;
    if (kind == 0) return bytes_.number();
    if (kind == 1) return std::ldexp(bytes_.small(), -(bytes_.byte() % 64));
    return bytes_.small() / full;
  }

  Edit edit_of(Kind kind) {
    Edit edit{kind, vertex(), {}, {}, {}};
    if (edit.kind == Kind::move || edit.kind == Kind::insert || edit.kind == Kind::move_loop)
      edit.place = place();
    if (edit.kind == Kind::move_loop && editor_.vertex(edit.vertex))
      edit.place = edit.place - *editor_.vertex(edit.vertex);
    if (edit.kind == Kind::bend) edit.bulge = bulge();
    if (edit.kind == Kind::insert_loop) {
      const int count = bytes_.byte() % 8;
      const bool bends = bytes_.byte() % 2 == 1;
      for (int i = 0; i < count; ++i) {
        edit.ring.points.push_back(place());
        if (bends) edit.ring.bulges.push_back(bulge());
      }
    }
    return edit;
  }

  void note(const Edit& edit) {
    constexpr const char* names[] = {"move",        "insert",      "remove",   "bend",
                                     "insert_loop", "remove_loop", "move_loop"};
    char text[200];
    std::snprintf(text, sizeof text, "%s %u %.17g %.17g %.17g\n",
                  names[static_cast<std::size_t>(edit.kind)], edit.vertex, edit.place.x,
                  edit.place.y, edit.bulge);
    log_ += text;
    for (std::size_t i = 0; i < edit.ring.points.size(); ++i) {
      std::snprintf(text, sizeof text, "  %.17g %.17g %.17g\n", edit.ring.points[i].x,
                    edit.ring.points[i].y, edit.ring.bulges.empty() ? 0 : edit.ring.bulges[i]);
      log_ += text;
    }
  }

  bool changes_nothing(const Edit& edit) const {
    return (edit.kind == Kind::move && editor_.vertex(edit.vertex) == edit.place) ||
           (edit.kind == Kind::bend && editor_.bulge(edit.vertex) == edit.bulge) ||
           (edit.kind == Kind::move_loop && edit.place == Vec2{});
  }

  void edit(const Edit& edit) {
    note(edit);
    const Editor before = editor_;
    const Shape shape = before.shape();
    const bool is_known = editor_.vertex(edit.vertex) || edit.kind == Kind::insert_loop;
    const bool is_nothing = is_known && changes_nothing(edit);
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < vertices_; ++v) count += editor_.vertex(v) ? 1 : 0;
    const bool is_compared = shows_all(before, shape, count);

    const auto change = make(edit, editor_);
    if (!change) {
      const Error& error = change.error();
      if (!is_named(error.code)) complain(to_string(error));
      if (is_known == (error.code == ErrorCode::invalid_option) && edit.kind != Kind::insert_loop)
        complain("the vertex: " + to_string(error));
      check_same(before);
      // A loop stays while it encloses others, even where these would do without it.
      const bool encloses =
          error.code == ErrorCode::hole_outside || error.code == ErrorCode::nested_outer;
      if (!is_known || !is_compared || encloses || error.code == ErrorCode::invalid_option) return;
      const auto expected = expected_of(edit, shape);
      if (expected && compute(*expected, {.threads = 1}))
        complain("refused, while build_shape() and compute() take it: " + to_string(error));
      return;
    }
    if (!is_known) complain("an unknown vertex was taken");
    if (is_nothing) return check_same(before);
    // Elsewhere it depends on where loops begin which vertex stays of arcs of one circle.
    if (is_compared || shape.bulges.empty())
      earlier_.push_back(outlines_of(shape));
    else
      earlier_.emplace_back();
    follow(*change);
    if (is_compared) {
      const auto expected = expected_of(edit, shape);
      const Shape now = editor_.shape();
      // Where arcs merge within the tolerance, build_shape() depends on where loops begin.
      const bool is_own = now.bulges.empty() || !change->everything;
      if (!expected && is_own)
        complain("accepted, while build_shape() says " + to_string(expected.error()));
      if (expected && is_own && outlines_of(*expected) != outlines_of(now)) {
        print(rings_of(*expected));
        complain("another shape than this one");
      }
    }
    check_axis();
  }

  void undo() {
    log_ += "undo\n";
    const Editor before = editor_;
    const auto change = editor_.undo();
    if (!change) complain("undo: " + to_string(change.error()));
    if (earlier_.empty()) return check_same(before);
    follow(*change);
    const auto& earlier = earlier_.back();
    if (!earlier.empty() && outlines_of(editor_.shape()) != earlier)
      complain("undo() makes another shape");
    earlier_.pop_back();
    check_axis();
  }

  /// The numbers of nodes and edges, as a change states them.
  void follow(const AxisChange& change) {
    const auto apply = [&](const auto& removed, const auto& added, auto& all) {
      for (const std::uint32_t i : removed)
        if (all.erase(i) != 1) complain("removed without being there");
      for (const std::uint32_t i : added)
        if (!all.insert(i).second) complain("added while it was there");
    };
    apply(change.removed_nodes, change.added_nodes, nodes_);
    apply(change.removed_edges, change.added_edges, edges_);
    vertices_ = std::max(vertices_, change.vertex + 1);
    while (editor_.vertex(vertices_)) ++vertices_;
  }

  void check_axis() {
    const MedialAxis axis = editor_.axis();
    if (axis.nodes.size() != nodes_.size() || axis.edges.size() != edges_.size())
      complain("the changes do not add up");
    for (const std::uint32_t i : edges_) {
      const auto edge = editor_.edge(i);
      if (!edge) complain("there is no such edge");
      for (std::size_t k = 0; k < 2; ++k)
        if (nodes_.count(edge->node[k]) == 0 || !editor_.site(edge->site[k]))
          complain("an edge without a node or site");
    }
    const Shape shape = editor_.shape();
    // Where coordinates of 1e97 and of 1 meet, all but a few sites are one point to the tolerance.
    const auto expected = compute(shape, {.threads = 1});
    if (expected && !test::graph_of(shape, *expected).failure.empty()) return;
    const std::string fault = test::fault_of(editor_);
    if (fault.empty()) return;
    // Which ties of arcs are contracted depends on how they are found (KNOWN_ISSUES.md).
    if (!shape.bulges.empty() && verify(shape, axis, {.threads = 1}).passed) return;
    complain(fault);
  }

  void check_same(const Editor& before) {
    const Shape a = before.shape(), b = editor_.shape();
    if (a.points != b.points || a.bulges != b.bulges || a.loop_begin != b.loop_begin ||
        a.hole != b.hole || a.component != b.component)
      complain("the shape has changed");
    const MedialAxis first = before.axis(), second = editor_.axis();
    bool is_same =
        first.nodes.size() == second.nodes.size() && first.edges.size() == second.edges.size();
    for (std::size_t i = 0; is_same && i < first.nodes.size(); ++i)
      is_same = first.nodes[i].disk.center == second.nodes[i].disk.center &&
                first.nodes[i].disk.radius == second.nodes[i].disk.radius &&
                first.nodes[i].component == second.nodes[i].component;
    for (std::size_t i = 0; is_same && i < first.edges.size(); ++i)
      is_same = first.edges[i].node == second.edges[i].node &&
                first.edges[i].site == second.edges[i].site &&
                first.edges[i].control.center == second.edges[i].control.center &&
                first.edges[i].weight == second.edges[i].weight;
    if (!is_same) complain("the axis has changed");
  }

  Bytes& bytes_;
  Editor editor_;
  Shape first_;
  std::optional<Kept> kept_;
  std::vector<std::vector<Outline>> earlier_;  ///< for each edit that can be undone; or nothing
  std::set<std::uint32_t> nodes_, edges_;
  std::uint32_t vertices_ = 0;  ///< all have numbers below
  std::string log_;
};

}  // namespace
}  // namespace medial::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial;
  fuzz::Bytes bytes(data, size);
  const auto shape = build_shape(fuzz::first_rings(bytes));
  if (!shape) return 0;
  auto editor = Editor::make(*shape);
  if (!editor) return 0;  // fuzz/shapes.cpp asks why
  fuzz::Session(bytes, std::move(editor).value()).run();
  return 0;
}

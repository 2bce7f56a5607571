// Lee (1982): Figs. 1 to 6, drawn again.

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "base/tolerance.h"
#include "medial/medial.h"
#include "methods/lee/diagram.h"
#include "methods/lee/merge.h"
#include "papers/figure.h"
#include "papers/lee_1982/experiment.h"
#include "site/bisector.h"

namespace medial::papers {

namespace {

constexpr double thick = 1.8;

/// Draws where two closed segments (or points) are equally far, cell by cell of a fine grid, each
/// component in its colour: which part of each one is nearest, an end or the inside.
void draw_bisector(Figure& figure, const Site& first, const Site& second) {
  constexpr int cells = 160;
  const Vec2 low = figure.box().low, size = figure.box().high - low;
  const auto at = [&](double i, double j) {
    return Vec2{low.x + size.x * i / cells, low.y + size.y * j / cells};
  };
  const auto difference = [&](Vec2 p) {
    return distance(foot(first, p), p) - distance(foot(second, p), p);
  };
  const auto part_of = [](const Site& site, Vec2 p) {
    const Vec2 f = foot(site, p);
    return f == site.start ? 0u : f == site.end ? 1u : 2u;
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const std::array<Vec2, 4> corner{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      std::vector<Vec2> crossings;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 a = corner[k], b = corner[(k + 1) % 4];
        const double da = difference(a), db = difference(b);
        if ((da < 0) != (db < 0)) crossings.push_back(a + (da / (da - db)) * (b - a));
      }
      if (crossings.size() != 2) continue;
      const Vec2 middle = midpoint(crossings[0], crossings[1]);
      figure.color(part_of(first, middle) + 3 * part_of(second, middle), thick);
      figure.line(crossings);
    }
  }
}

Site segment(Vec2 a, Vec2 b) { return {a, b}; }

/// A polygon for Figs. 3 to 6 with the chains of the paper's: e_1, e_2, e_3 and e_4 to e_10 in its
/// first half, e_11 to e_21 in its second one; 14 segments and seven reflex vertices.
Shape polygon() {
  const Ring ring{{{0, 0},
                   {9, -1},
                   {19, 0},
                   {23, 4},
                   {17, 5},
                   {15, 7},
                   {15, 10},
                   {17, 15},
                   {12, 12},
                   {9, 16},
                   {7, 11},
                   {3, 9.5},
                   {-2, 12},
                   {1, 5}}};
  return build_shape(std::vector<Ring>{ring}).value();
}

void draw_polygon(Figure& figure, const Shape& shape) {
  std::vector<Vec2> outline(shape.points.begin(), shape.points.end());
  outline.push_back(outline.front());
  figure.ink();
  figure.line(outline);
}

std::vector<Vec2> samples(const VoronoiDiagram& diagram, const VoronoiEdge& edge) {
  MedialAxis one;
  one.nodes = diagram.nodes;
  one.sites = diagram.sites;
  std::vector<Vec2> line;
  for (const Disk& disk : sample_by_chord(one, edge, 1e-3)) line.push_back(disk.center);
  return line;
}

void draw_diagram(Figure& figure, const VoronoiDiagram& diagram, bool spokes) {
  for (const VoronoiEdge& edge : diagram.edges) {
    if (edge.spoke && !spokes) continue;
    if (edge.spoke)
      figure.thin();
    else
      figure.pen(0.15, 0.45, 0.75, 1.6);
    figure.line(samples(diagram, edge));
  }
}

Box with_room(const Shape& shape, double room) {
  const Box box = bounding_box(shape);
  return {box.low - Vec2{room, room}, box.high + Vec2{room, room}};
}

/// Fig. 6: lists of chains before and after the last merge. Here the frame is the identity.
class Halves {
 public:
  explicit Halves(const Shape& shape) : Halves(Problem(shape, Options{})) {}
  explicit Halves(Problem problem)
      : elements_((problem.frame = {}, lee::elements_of(problem).value())),
        diagram_(elements_),
        limits_{problem.tolerance, 4 * diagonal(problem.box)} {
    const auto count = static_cast<std::uint32_t>(elements_.chains.size() - 1);
    int deepest = 0;
    while ((1u << deepest) < count) ++deepest;
    for (int level = deepest - 1; level >= 1; --level) merge_level(level, count);
  }
  void merge_last() { merge_level(0, static_cast<std::uint32_t>(elements_.chains.size() - 1)); }

  /// The edges among one half's elements, or among all (2); the merge curve in red.
  void draw(Figure& figure, int half) const {
    const auto count = static_cast<std::uint32_t>(elements_.chains.size() - 1);
    const std::uint32_t middle = elements_.chains[(count + 1) / 2];
    figure.thin();
    for (std::uint32_t i = 0; i < elements_.size(); ++i) {
      const site::Site& site = elements_.sites[i];
      if (site.is_vertex()) continue;
      if (half == 2 || (i < middle) == (half == 0))
        figure.ink();
      else
        figure.thin();
      figure.line({site.point, site.end()});
    }
    for (std::uint32_t i = 0; i < elements_.size() && half < 2; ++i) {
      if ((i < middle) != (half == 0)) continue;
      figure.ink();
      // Outside of the polygon, beside the element.
      const site::Site& site = elements_.sites[i];
      const site::Site& beside = site.is_vertex() ? elements_.sites[i - 1] : site;
      const Vec2 at = site.is_vertex() ? site.point : midpoint(site.point, site.end());
      figure.mark(at - 0.7 * beside.normal(), ("e" + std::to_string(i + 1)).c_str());
    }
    const std::vector<std::uint32_t> outer = outer_edges();
    for (std::uint32_t i = 0; i < elements_.size(); ++i)
      if (half == 2 || (i < middle) == (half == 0))
        for (std::uint32_t place = diagram_.top[i][0]; place != none;
             place = diagram_.edges[place].inward[0])
          draw_edge(figure, diagram_.edges[place], outer[place], middle);
  }

 private:
  void merge_level(int level, std::uint64_t count) {
    Statistics statistics;
    for (std::uint64_t i = 0; i < std::uint64_t{1} << level; ++i) {
      const auto at = [&](int k, std::uint64_t j) {
        const std::uint64_t lists = std::uint64_t{1} << k;
        return static_cast<std::uint32_t>((count * j + lists - 1) / lists);
      };
      const std::uint32_t first = at(level, i), middle = at(level + 1, 2 * i + 1),
                          end = at(level, i + 1);
      if (first != middle && middle != end)
        lee::merge(diagram_, first, middle, end, limits_, statistics);
    }
  }

  /// Of each edge: the one that begins where it ends, if one does.
  std::vector<std::uint32_t> outer_edges() const {
    std::vector<std::uint32_t> outer(diagram_.edges.size(), none);
    for (std::uint32_t i = 0; i < elements_.size(); ++i)
      for (const std::size_t k : {0u, 1u})
        for (std::uint32_t place = diagram_.top[i][k]; place != none;
             place = diagram_.edges[place].inward[k])
          if (const std::uint32_t inner = diagram_.edges[place].inward[k]; inner != none)
            outer[inner] = place;
    return outer;
  }

  /// Whether a point's foot on an element's line lies on the element, up to rounding.
  bool is_beside(std::uint32_t i, Vec2 p) const {
    constexpr double slack = 1e-9;
    const site::Site& site = elements_.sites[i];
    const Vec2 d = p - site.point;
    if (site.is_vertex())
      return dot(elements_.sites[i - 1].direction, d) >= -slack &&
             dot(elements_.sites[i + 1].direction, d) <= slack;
    return dot(site.direction, d) >= -slack && dot(site.direction, d) <= site.length + slack;
  }

  /// `outer`: the edge that begins where this one ends.
  void draw_edge(Figure& figure, const lee::ListEdge& edge, std::uint32_t outer,
                 std::uint32_t middle) const {
    const auto [i, j] = edge.element;
    const site::Site &left = elements_.sites[i], &right = elements_.sites[j];
    const bool on_curve = i < middle && j >= middle;
    if (diagram_.is_spoke(edge))
      figure.thin();
    else if (on_curve)
      figure.pen(0.80, 0.20, 0.20, 2.2);
    else
      figure.pen(0.15, 0.45, 0.75, 1.6);
    const Vec2 start = edge.inner.center;
    const Vec2 end = outer != none ? diagram_.edges[outer].inner.center : start;
    if (diagram_.is_spoke(edge)) {
      const Vec2 normal = left.is_vertex() ? right.normal() : left.normal();
      figure.line({start, outer != none ? end : start + 60 * normal});
      return;
    }
    const site::Bisector bisector(right, left);
    const double from = bisector.position(start);
    const bool last = i == 0 && j + 1 == elements_.size();
    double to = from + 60;
    if (outer != none) to = bisector.position(end);
    if (outer == none && last) to = bisector.position(elements_.sites[0].point);
    const int pieces = outer == none && !last ? 256 : 48;
    std::vector<Vec2> line;
    for (int k = 0; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const Vec2 p = bisector.disk_at(from + t * (to - from), edge.inner).center;
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) break;
      if (outer == none && !last && !(is_beside(i, p) && is_beside(j, p))) break;
      line.push_back(p);
    }
    figure.line(line);
  }

  lee::Elements elements_;
  lee::Diagram diagram_;
  lee::MergeLimits limits_;
};

Status figure_of_point_and_segment(const std::filesystem::path& path) {
  Figure figure({{-4, -2.6}, {4, 3.4}});
  const Vec2 q{0.4, 1.2}, a{-1.5, 0}, b{1.5, 0};
  draw_bisector(figure, segment(q, q), segment(a, b));
  figure.ink();
  figure.line({a, b});
  for (const auto& [p, name] : {std::pair{q, "q"}, {a, "a"}, {b, "b"}}) {
    figure.dot(p);
    figure.label(p, name);
  }
  for (const auto& [p, name] : {std::pair{Vec2{-2.9, 2.0}, "B(q, a)"},
                                {{-0.4, 0.15}, "B(q, (a, b))"},
                                {{2.6, 1.5}, "B(q, b)"}})
    figure.label(p, name);
  return figure.write(path);
}

Status figure_of_two_segments(const std::filesystem::path& path) {
  Figure figure({{-4, -3}, {4, 3.2}});
  const Vec2 a{-2.2, 1.0}, b{1.6, 1.9}, c{-1.2, -0.8}, d{2.4, -1.6};
  draw_bisector(figure, segment(a, b), segment(c, d));
  figure.ink();
  figure.line({a, b});
  figure.line({c, d});
  for (const auto& [p, name] : {std::pair{a, "a"}, {b, "b"}, {c, "c"}, {d, "d"}}) {
    figure.dot(p);
    figure.label(p, name);
  }
  for (const auto& [p, name] : {std::pair{Vec2{-3.4, -0.1}, "B(a, c)"},
                                {{-2.3, 0.5}, "B(c, (a, b))"},
                                {{-0.4, 0.4}, "B((a, b), (c, d))"},
                                {{1.9, -0.3}, "B(b, (c, d))"},
                                {{3.1, 0.8}, "B(b, d)"}})
    figure.label(p, name);
  return figure.write(path);
}

Status figure_of_diagram(const std::filesystem::path& path, bool spokes) {
  const Shape shape = polygon();
  const auto diagram = voronoi_diagram(shape, {.threads = 1});
  if (!diagram) return diagram.error();
  Figure figure(with_room(shape, 0.5));
  draw_diagram(figure, *diagram, spokes);
  draw_polygon(figure, shape);
  return figure.write(path);
}

/// Lemma 1: from z to its image on its element; Lemma 2: an empty disk that touches two elements.
Status figure_of_lemmas(const std::filesystem::path& path) {
  const Shape shape = polygon();
  const auto diagram = voronoi_diagram(shape, {.threads = 1});
  if (!diagram) return diagram.error();
  Figure figure(with_room(shape, 0.5));
  draw_diagram(figure, *diagram, true);
  const Vec2 z{13, 1.5};
  const auto nearest = std::min_element(diagram->sites.begin(), diagram->sites.end(),
                                        [&](const Site& a, const Site& b) {
                                          return distance(foot(a, z), z) < distance(foot(b, z), z);
                                        });
  figure.color(0, thick);
  figure.line({z, foot(*nearest, z)});
  figure.dot(z);
  figure.label(z, "z");
  std::size_t longest = 0;
  for (std::size_t e = 0; e < diagram->edges.size(); ++e)
    if (!diagram->edges[e].spoke && diagram->nodes[diagram->edges[e].node[0]].disk.radius > 3)
      longest = e;
  MedialAxis one;
  one.nodes = diagram->nodes;
  one.sites = diagram->sites;
  const VoronoiEdge& edge = diagram->edges[longest];
  const Disk disk = disk_at(one, edge, 0.5);
  figure.color(2, thick);
  figure.circle(disk);
  for (const std::uint32_t site : edge.site) {
    figure.line({disk.center, foot(diagram->sites[site], disk.center)});
    figure.dot(foot(diagram->sites[site], disk.center));
  }
  draw_polygon(figure, shape);
  return figure.write(path);
}

Status figures_of_merge(const std::filesystem::path& directory) {
  const Shape shape = polygon();
  Halves halves(shape);
  for (const auto& [half, name] : {std::pair{0, "fig6a.svg"}, {1, "fig6b.svg"}}) {
    Figure figure(with_room(shape, 2.5));
    halves.draw(figure, half);
    Status written = figure.write(directory / name);
    if (!written) return written;
  }
  halves.merge_last();
  Figure figure(with_room(shape, 2.5));
  halves.draw(figure, 2);
  return figure.write(directory / "fig6c.svg");
}

}  // namespace

Status draw_lee_figures(const Request& request) {
  const std::filesystem::path& to = request.to;
  return in_order([&] { return figure_of_point_and_segment(to / "fig1.svg"); },
                  [&] { return figure_of_two_segments(to / "fig2.svg"); },
                  [&] { return figure_of_diagram(to / "fig3.svg", true); },
                  [&] { return figure_of_diagram(to / "fig4.svg", false); },
                  [&] { return figure_of_lemmas(to / "fig5.svg"); },
                  [&] { return figures_of_merge(to); });
}

}  // namespace medial::papers

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/quadrature.h"
#include "medial/query.h"
#include "verify/checks.h"
#include "verify/distance_tree.h"

namespace medial {
namespace verify_detail {
namespace {

class VoronoiCheck {
 public:
  VoronoiCheck(const PlanarGraph& planar_graph, const VoronoiDiagram& diagram,
               const VerifyOptions& options, VoronoiCertificate& certificate)
      : planar_graph_(planar_graph),
        diagram_(diagram),
        options_(options),
        certificate_(certificate) {}

  void run() {
    certificate_.sites = diagram_.sites.size();
    if (!check_values() || !check_sites()) return;
    enclosure_ = *diagram_.enclosure;
    constexpr double default_relative = 1e-13;
    const double relative = options_.tolerance > 0 ? options_.tolerance : default_relative;
    tolerance_ = std::max(
        {relative * diagonal(enclosure_), 4 * spacing_in(enclosure_), 4 * diagram_.tolerance});
    certificate_.tolerance = tolerance_;
    check_disks();
    check_faces();
    check_connected();
  }

 private:
  void fail(std::string failure) { certificate_.failures.push_back(std::move(failure)); }

  /// Whether the diagram can be worked with at all.
  bool check_values() {
    const auto finite = [](const Disk& disk) {
      return std::isfinite(disk.center.x) && std::isfinite(disk.center.y) &&
             std::isfinite(disk.radius);
    };
    const std::size_t sites = diagram_.sites.size(), nodes = diagram_.nodes.size();
    bool sound = diagram_.enclosure.has_value() && diagram_.face_begin.size() == sites + 1;
    if (!diagram_.enclosure) fail("The diagram has no enclosure, so it is not of a planar graph.");
    for (const Node& node : diagram_.nodes)
      sound = sound && finite(node.disk) && node.disk.radius >= 0;
    for (const VoronoiEdge& edge : diagram_.edges) {
      sound = sound && edge.node[0] < nodes && edge.node[1] < nodes && edge.site[0] < sites &&
              (edge.on_enclosure ? edge.site[1] == no_site : edge.site[1] < sites) &&
              finite(edge.control) && std::isfinite(edge.weight) && edge.weight > 0;
    }
    for (std::size_t i = 0; sound && i < sites; ++i)
      sound = diagram_.face_begin[i] <= diagram_.face_begin[i + 1];
    sound = sound && diagram_.face_begin.front() == 0 &&
            diagram_.face_begin.back() == diagram_.face_edges.size();
    for (const std::uint32_t edge : diagram_.face_edges)
      sound = sound && edge < diagram_.edges.size();
    if (!sound) fail("The diagram is malformed.");
    return sound;
  }

  /// Whether the sites are the planar graph's points, then its edges, in their order.
  bool check_sites() {
    const std::size_t points = planar_graph_.points.size();
    bool same = diagram_.sites.size() == points + planar_graph_.edges.size();
    for (std::size_t i = 0; same && i < diagram_.sites.size(); ++i) {
      const Site& site = diagram_.sites[i];
      if (i < points) {
        same = site.kind() == SiteKind::vertex && site.start == planar_graph_.points[i];
        continue;
      }
      const PlanarGraphEdge& edge = planar_graph_.edges[i - points];
      same = site.start == planar_graph_.points[edge.from] &&
             site.end == planar_graph_.points[edge.to] && site.bulge == edge.bulge;
    }
    if (!same) fail("The sites are not those of the input.");
    return same;
  }

  /// Samples of every edge against the nearest site of all and the edge's own.
  void check_disks() {
    std::vector<BoundaryEdge> edges;
    edges.reserve(diagram_.sites.size());
    bool arcs = false;
    std::vector<bool> ends_edge(planar_graph_.points.size());
    for (const PlanarGraphEdge& edge : planar_graph_.edges)
      ends_edge[edge.from] = ends_edge[edge.to] = true;
    for (std::size_t i = 0; i < diagram_.sites.size(); ++i) {
      if (i < planar_graph_.points.size() && ends_edge[i]) continue;
      edges.push_back(edge_of(diagram_.sites[i]));
      arcs = arcs || edges.back().bulge != 0;
    }
    const DistanceTree tree(std::move(edges), enclosure_, arcs);
    struct Findings {
      Worst residual, contact, off_enclosure;
      std::uint64_t disks = 0;
    };
    const int parts = 1 + std::clamp(options_.samples_per_edge, 0, 1 << 20);
    const auto findings =
        in_blocks<Findings>(diagram_.edges.size(), block_size, [&](std::size_t e, Findings& found) {
          const VoronoiEdge& edge = diagram_.edges[e];
          for (int k = 0; k <= parts; ++k) {
            const Disk disk = disk_on(edge, static_cast<double>(k) / parts);
            const double nearest = tree.distance(disk.center, disk.radius);
            found.residual.add(std::abs(nearest - disk.radius), tolerance_, disk.center);
            for (const std::uint32_t site : edge.site) {
              if (site == no_site) continue;
              const double own = distance_to_edge(disk.center, edge_of(diagram_.sites[site]));
              found.contact.add(std::abs(own - disk.radius), tolerance_, disk.center);
            }
            if (edge.on_enclosure)
              found.off_enclosure.add(off_enclosure(disk.center), tolerance_, disk.center);
            ++found.disks;
          }
        });
    Findings all;
    for (const Findings& found : findings) {
      all.residual.add(found.residual);
      all.contact.add(found.contact);
      all.off_enclosure.add(found.off_enclosure);
      all.disks += found.disks;
    }
    certificate_.largest_residual = all.residual.value;
    certificate_.largest_contact_gap = all.contact.value;
    certificate_.worst = all.residual.where;
    certificate_.disks_checked = all.disks;
    const auto tell = [&](const Worst& largest, const char* what) {
      if (largest.over > 0)
        fail(sentence("%llu disks %s, the worst by %.3g at (%.10g, %.10g).",
                      static_cast<unsigned long long>(largest.over), what, largest.value,
                      largest.where.x, largest.where.y));
    };
    tell(all.residual, "have a radius that is not the distance to the nearest site");
    tell(all.contact, "do not touch a site of their edge");
    tell(all.off_enclosure, "of the enclosure's edges are off it");
  }

  Disk disk_on(const VoronoiEdge& edge, double t) const {
    const Disk &from = diagram_.nodes[edge.node[0]].disk, &to = diagram_.nodes[edge.node[1]].disk;
    const double a = (1 - t) * (1 - t), b = 2 * edge.weight * t * (1 - t), c = t * t;
    const double scale = 1 / (a + b + c);
    return {scale * (a * from.center + b * edge.control.center + c * to.center),
            scale * (a * from.radius + b * edge.control.radius + c * to.radius)};
  }

  double off_enclosure(Vec2 p) const {
    const double inside = std::min({p.x - enclosure_.low.x, enclosure_.high.x - p.x,
                                    p.y - enclosure_.low.y, enclosure_.high.y - p.y});
    return std::abs(inside);
  }

  /// Of the triangle p q r of a conic's control points, the share between the conic and its chord:
  /// 2 w times the integral of 1 / (1 + 2 w v + v^2)^2 over all v > 0, in closed form; next to the
  /// parabola (2 / 3), where that cancels, by Gauss's rule.
  static double share_of_triangle(double w) {
    const double k = (1 - w) * (1 + w);
    if (w < 0.5) return w * (std::acos(w) / (k * std::sqrt(k)) - w / k);
    if (w > 2) return w * (std::acosh(w) / (k * std::sqrt(-k)) - w / k);
    constexpr int parts = 64;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
      for (const auto& [place, weight] : gauss3) {
        const double t = (i + 0.5 + 0.5 * place) / parts, s = 1 - t;
        const double scale = s * s + 2 * w * s * t + t * t;
        sum += weight * t * t / (scale * scale);
      }
    }
    return w * sum / parts;
  }

  /// Twice the area that an edge sweeps as seen from a point.
  double swept(const VoronoiEdge& edge, Vec2 from) const {
    const Vec2 p = diagram_.nodes[edge.node[0]].disk.center,
               r = diagram_.nodes[edge.node[1]].disk.center;
    const double triangle = cross(edge.control.center - p, r - p);
    const double share =
        triangle == 0 || edge.weight == 1 ? 2.0 / 3 : share_of_triangle(edge.weight);
    return cross(p - from, r - from) + share * triangle;
  }

  /// Closed walks, the right way around, that fill the enclosure; every edge in both of its faces.
  void check_faces() {
    struct Findings {
      std::uint64_t faces = 0, broken = 0;
      double area = 0;
    };
    std::vector<std::uint8_t> used(2 * diagram_.edges.size());
    const double whole =
        (enclosure_.high.x - enclosure_.low.x) * (enclosure_.high.y - enclosure_.low.y);
    constexpr double relative = 1e-9;
    const auto findings = in_blocks<Findings>(
        diagram_.sites.size(), block_size, [&](std::size_t site, Findings& found) {
          const auto face = diagram_.face(site);
          if (face.empty()) return;
          ++found.faces;
          const Vec2 middle = diagram_.sites[site].start;
          double doubled = 0, around = 0;
          bool sound = true;
          for (std::size_t i = 0; i < face.size(); ++i) {
            const VoronoiEdge& edge = diagram_.edges[face[i]];
            const VoronoiEdge& next = diagram_.edges[face[(i + 1) % face.size()]];
            const bool forward = edge.site[1] == site;
            sound = sound && (forward || edge.site[0] == site) &&
                    edge.node[forward ? 1 : 0] == next.node[next.site[1] == site ? 0 : 1];
            // Each side belongs to one site, and a site's face is looked at once.
            if (sound && used[2 * face[i] + (forward ? 1 : 0)] < 2)
              ++used[2 * face[i] + (forward ? 1 : 0)];
            // The face is on the right of its walk.
            doubled += (forward ? -1 : 1) * swept(edge, middle);
            for (const std::uint32_t node : edge.node)
              around += distance(diagram_.nodes[node].disk.center, edge.control.center);
          }
          // Points that are off by the tolerance move a face's border by as much.
          sound = sound && doubled >= -2 * (relative * whole + tolerance_ * around);
          if (!sound) ++found.broken;
          found.area += 0.5 * doubled;
        });
    for (const Findings& found : findings) {
      certificate_.faces += found.faces;
      certificate_.broken_faces += found.broken;
      certificate_.faces_area += found.area;
    }
    certificate_.enclosure_area = whole;
    if (certificate_.broken_faces > 0)
      fail(sentence("%llu faces are not closed walks around their sites.",
                    static_cast<unsigned long long>(certificate_.broken_faces)));
    std::uint64_t missing = 0;
    for (std::size_t e = 0; e < diagram_.edges.size(); ++e)
      for (const std::size_t side : {0U, 1U})
        if (used[2 * e + side] != (diagram_.edges[e].site[side] == no_site ? 0 : 1)) ++missing;
    if (missing > 0)
      fail(sentence("%llu sides of edges are not in one face.",
                    static_cast<unsigned long long>(missing)));
    if (!(std::abs(certificate_.faces_area - whole) <= relative * whole))
      fail(sentence("The faces have an area of %.10g in an enclosure of %.10g.",
                    certificate_.faces_area, whole));
  }

  void check_connected() {
    DisjointSets sets(diagram_.nodes.size());
    for (const VoronoiEdge& edge : diagram_.edges) sets.join(edge.node[0], edge.node[1]);
    if (sets.count() != 1)
      fail(sentence("The graph has %llu parts.", static_cast<unsigned long long>(sets.count())));
  }

  const PlanarGraph& planar_graph_;
  const VoronoiDiagram& diagram_;
  const VerifyOptions& options_;
  VoronoiCertificate& certificate_;
  Box enclosure_;
  double tolerance_ = 0;
};

}  // namespace
}  // namespace verify_detail

VoronoiCertificate verify(const PlanarGraph& planar_graph, const VoronoiDiagram& diagram,
                          const VerifyOptions& options) {
  VoronoiCertificate certificate;
  verify_detail::certify(options.threads, certificate, [&] {
    verify_detail::VoronoiCheck(planar_graph, diagram, options, certificate).run();
  });
  return certificate;
}

}  // namespace medial

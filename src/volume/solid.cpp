// From triangles as a file holds them to a solid: joined, checked, turned, nested.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/in_flight.h"
#include "base/predicates.h"
#include "base/vec3.h"
#include "medial/volume.h"
#include "shape/limits.h"
#include "volume/face_tree.h"
#include "volume/predicates.h"

namespace medial {
namespace {

using volume::Face;
using volume::FaceTree;
using volume::Triangle;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Error error_at_point(ErrorCode code, std::string text, Vec3 point,
                     std::optional<std::uint64_t> face) {
  Error error{code, std::move(text), {}};
  error.place.point = Vec2{point.x, point.y};
  error.place.z = point.z;
  error.place.face = face;
  return error;
}

Error error_at_vertex(ErrorCode code, std::string text, std::uint64_t vertex) {
  Error error{code, std::move(text), {}};
  error.place.vertex = vertex;
  return error;
}

std::optional<Error> refuse(const TriangleMesh& mesh) {
  constexpr std::size_t most = std::size_t{1} << 31U;
  if (mesh.faces.empty()) return Error{ErrorCode::empty, "the mesh has no face", {}};
  if (mesh.vertices.size() >= most || mesh.faces.size() >= most)
    return Error{ErrorCode::too_large, "the mesh has 2^31 vertices or faces", {}};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = mesh.vertices[i][axis];
      if (!std::isfinite(value))
        return error_at_vertex(ErrorCode::not_finite, "a coordinate is not finite", i);
      if (!is_within_limits(value))
        return error_at_vertex(ErrorCode::unsupported,
                               "a coordinate is beyond 1e100 in size, or below 1e-100", i);
    }
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    for (const std::uint32_t vertex : mesh.faces[i]) {
      if (vertex < mesh.vertices.size()) continue;
      Error error{ErrorCode::malformed, "a face refers to a vertex that does not exist", {}};
      error.place.face = i;
      return error;
    }
  }
  return std::nullopt;
}

/// Merges equal vertices, and drops unused vertices and faces that lost a corner.
void join_vertices(Solid& solid) {
  TriangleMesh& mesh = solid.surface;
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Vec3 p = mesh.vertices[i];
    return std::array<double, 3>{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const auto a = key(i), b = key(j);
    return a < b || (a == b && i < j);
  });
  std::vector<std::uint32_t> first(mesh.vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && mesh.vertices[order[k - 1]] == mesh.vertices[order[k]];
    first[order[k]] = again ? first[order[k - 1]] : order[k];
    solid.report.joined_vertices += again;
  }
  std::vector<Face> faces;
  faces.reserve(mesh.faces.size());
  for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
    const Face face = {first[mesh.faces[i][0]], first[mesh.faces[i][1]], first[mesh.faces[i][2]]};
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      ++solid.report.dropped_faces;
      continue;
    }
    faces.push_back(face);
    solid.source.push_back(i);
  }
  // The vertices in use, in their old order.
  std::vector<std::uint32_t> index(mesh.vertices.size(), none);
  for (const Face& face : faces)
    for (const std::uint32_t vertex : face) index[vertex] = 0;
  std::vector<Vec3> vertices;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    if (index[i] == none) {
      solid.report.unused_vertices += first[i] == i;
      continue;
    }
    index[i] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(mesh.vertices[i]);
  }
  for (Face& face : faces)
    for (std::uint32_t& vertex : face) vertex = index[vertex];
  mesh.vertices = std::move(vertices);
  mesh.faces = std::move(faces);
}

/// For side k of face f (from corner k to the next), at 3 f + k: the side of the other face.
using Sides = std::vector<std::uint32_t>;

Result<Sides> pair_sides(const Solid& solid) {
  const TriangleMesh& mesh = solid.surface;
  struct Side {
    std::uint32_t low, high, at;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), 3 * f + k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.at) < std::tie(b.low, b.high, b.at);
  });
  Sides other(sides.size());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
      ++end;
    if (end - i != 2) {
      const Vec3 middle = mesh.vertices[sides[i].low] +
                          0.5 * (mesh.vertices[sides[i].high] - mesh.vertices[sides[i].low]);
      const bool open = end - i == 1;
      return error_at_point(open ? ErrorCode::open_surface : ErrorCode::non_manifold,
                            open ? "the surface is open: an edge has one face"
                                 : "an edge has " + std::to_string(end - i) + " faces",
                            middle, solid.source[sides[i].at / 3]);
    }
    other[sides[i].at] = sides[i + 1].at;
    other[sides[i + 1].at] = sides[i].at;
    i = end;
  }
  return other;
}

/// Turns faces so that neighbours agree, and numbers the connected surfaces. O(faces). False if
/// that cannot be had, which crossing faces alone can cause.
bool orient(Solid& solid, Sides& other, std::vector<std::uint32_t>& surface_of,
            std::vector<bool>& turned) {
  TriangleMesh& mesh = solid.surface;
  surface_of.assign(mesh.faces.size(), none);
  turned.assign(mesh.faces.size(), false);
  std::vector<std::uint32_t> stack;
  std::uint32_t surfaces = 0;
  bool orientable = true;
  for (std::uint32_t start = 0; start < mesh.faces.size(); ++start) {
    if (surface_of[start] != none) continue;
    surface_of[start] = surfaces;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t side = other[3 * f + k];
        const std::uint32_t g = side / 3;
        // Neighbours agree if they walk along their edge in opposite directions.
        const bool same = mesh.faces[f][k] == mesh.faces[g][side % 3];
        const bool turn = turned[f] != same;
        if (surface_of[g] == none) {
          surface_of[g] = surfaces;
          turned[g] = turn;
          stack.push_back(g);
        } else if (turned[g] != turn) {
          orientable = false;
        }
      }
    }
    ++surfaces;
  }
  return orientable;
}

/// Gives each fan of faces around a vertex a vertex of its own. Returns which vertices lie in the
/// place of another one now.
std::vector<bool> part_vertices(Solid& solid, const Sides& other) {
  TriangleMesh& mesh = solid.surface;
  std::vector<bool> seen(3 * mesh.faces.size(), false);  // corner k of face f
  std::vector<bool> taken(mesh.vertices.size(), false);
  std::vector<bool> touching(mesh.vertices.size(), false);
  std::vector<std::uint32_t> fan;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (seen[3 * f + k]) continue;
      const std::uint32_t vertex = mesh.faces[f][k];
      fan.assign(1, 3 * f + k);
      seen[3 * f + k] = true;
      for (std::size_t i = 0; i < fan.size(); ++i) {
        const std::uint32_t face = fan[i] / 3, corner = fan[i] % 3;
        // The two sides at this corner lead to the neighbours in the fan.
        for (const std::uint32_t side :
             {other[3 * face + corner], other[3 * face + (corner + 2) % 3]}) {
          const std::uint32_t g = side / 3;
          for (std::uint32_t c = 0; c < 3; ++c) {
            if (mesh.faces[g][c] != vertex || seen[3 * g + c]) continue;
            seen[3 * g + c] = true;
            fan.push_back(3 * g + c);
          }
        }
      }
      if (!taken[vertex]) {
        taken[vertex] = true;
        continue;
      }
      const auto copy = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(Vec3(mesh.vertices[vertex]));
      taken.push_back(true);
      touching.push_back(true);
      touching[vertex] = true;
      ++solid.report.parted_vertices;
      for (const std::uint32_t corner : fan) mesh.faces[corner / 3][corner % 3] = copy;
    }
  }
  return touching;
}

/// The first pair of faces that share more than corners and edges, as an error.
std::optional<Error> find_crossing(const Solid& solid, const FaceTree& tree) {
  const TriangleMesh& mesh = solid.surface;
  std::optional<Error> found;
  const auto triangle = [&](std::uint32_t f) {
    return volume::triangle_of(mesh.vertices, mesh.faces[f]);
  };
  const auto check = [&](std::uint32_t f, std::uint32_t g) {
    const Face& a = mesh.faces[f];
    const Face& b = mesh.faces[g];
    // Shared corners, by their place in both.
    std::array<std::pair<int, int>, 3> shared;
    int count = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (mesh.vertices[a[static_cast<std::size_t>(i)]] ==
            mesh.vertices[b[static_cast<std::size_t>(j)]])
          shared[static_cast<std::size_t>(count++)] = {i, j};
    const Triangle s = triangle(f), t = triangle(g);
    const auto corner = [](const Triangle& of, int i) { return of.corner[i % 3]; };
    bool crossing = false, overlap = false;
    if (count == 0) {
      crossing = volume::triangles_meet(s.corner, t.corner);
    } else if (count == 1) {
      const auto [i, j] = shared[0];
      crossing = volume::segment_meets_triangle(corner(s, i + 1), corner(s, i + 2), t.corner) ||
                 volume::segment_meets_triangle(corner(t, j + 1), corner(t, j + 2), s.corner);
    } else if (count == 2) {
      const Vec3 u = corner(s, shared[0].first), v = corner(s, shared[1].first);
      const Vec3 p = corner(s, 3 - shared[0].first - shared[1].first);
      const Vec3 q = corner(t, 3 - shared[0].second - shared[1].second);
      overlap = volume::orientation(u, v, p, q) == 0 && volume::same_side(u, v, p, q);
    } else {
      overlap = true;
    }
    if (!crossing && !overlap) return true;
    const std::string names =
        "faces " + std::to_string(solid.source[f]) + " and " + std::to_string(solid.source[g]);
    found = error_at_point(crossing ? ErrorCode::crossing : ErrorCode::overlap,
                           names + (crossing ? " cross or touch" : " overlap"), s.corner[0],
                           solid.source[f]);
    return false;
  };
  tree.each_pair([&](std::uint32_t f) { return triangle(f).box(); }, check);
  return found;
}

/// Whether the ray from p in the direction of +x crosses a face. Requires p not on the face.
bool ray_crosses(Vec3 p, const Triangle& face) {
  if (!volume::line_crosses({p.y, p.z}, face.corner)) return false;
  const auto& [a, b, c] = face.corner;
  const int turn = orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z});
  return volume::orientation(a, b, c, p) * turn < 0;
}

/// How many other surfaces lie around each surface, and whether its faces point outwards.
struct Nesting {
  std::vector<std::uint32_t> depth;
  std::vector<bool> outward;
};

Result<Nesting> nest(const Solid& solid, const FaceTree& tree,
                     const std::vector<std::uint32_t>& surface_of, std::uint32_t surfaces,
                     const std::vector<bool>& touching) {
  const TriangleMesh& mesh = solid.surface;
  // A vertex of each surface that lies on no other one.
  std::vector<std::uint32_t> tip(surfaces, none);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t vertex : mesh.faces[f])
      if (!touching[vertex]) tip[surface_of[f]] = std::min(tip[surface_of[f]], vertex);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (tip[surface_of[f]] == none)
      return error_at_point(ErrorCode::non_manifold, "a surface touches others in all its vertices",
                            mesh.vertices[mesh.faces[f][0]], solid.source[f]);
  Nesting nesting;
  nesting.depth.assign(surfaces, 0);
  nesting.outward.assign(surfaces, true);
  // Signed volumes about each tip; of simple closed surfaces, so that the sign is well off zero
  // unless the surface is flat, and then there is nothing inside it.
  std::vector<double> volume(surfaces, 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 origin = mesh.vertices[tip[surface_of[f]]];
    const Triangle face = volume::triangle_of(mesh.vertices, mesh.faces[f]);
    volume[surface_of[f]] +=
        dot(face.corner[0] - origin, cross(face.corner[1] - origin, face.corner[2] - origin));
  }
  std::vector<std::uint32_t> crossed;
  for (std::uint32_t s = 0; s < surfaces; ++s) {
    nesting.outward[s] = volume[s] > 0;
    if (surfaces == 1) break;
    const Vec3 p = mesh.vertices[tip[s]];
    const volume::Box3 ray{p, {std::numeric_limits<double>::infinity(), p.y, p.z}};
    crossed.clear();
    tree.visit([&](const volume::Box3& box) { return box.meets(ray); },
               [&](std::uint32_t k) {
                 const std::uint32_t f = tree.order()[k];
                 if (surface_of[f] != s &&
                     ray_crosses(p, volume::triangle_of(mesh.vertices, mesh.faces[f])))
                   crossed.push_back(surface_of[f]);
                 return true;
               });
    // Surfaces crossed an odd number of times lie around this one.
    std::sort(crossed.begin(), crossed.end());
    for (auto at = crossed.begin(); at != crossed.end();) {
      const auto end = std::upper_bound(at, crossed.end(), *at);
      nesting.depth[s] += static_cast<std::uint32_t>((end - at) % 2);
      at = end;
    }
  }
  return nesting;
}

Result<Solid> make_solid(TriangleMesh mesh) {
  if (auto error = refuse(mesh)) return std::move(*error);
  Solid solid;
  solid.report.input_vertices = mesh.vertices.size();
  solid.report.input_faces = mesh.faces.size();
  solid.surface = std::move(mesh);
  join_vertices(solid);
  if (solid.surface.faces.empty())
    return Error{ErrorCode::no_area, "no face of the mesh has an area", {}};
  auto other = pair_sides(solid);
  if (!other) return std::move(other).error();

  const FaceTree tree(solid.surface.vertices, solid.surface.faces);
  if (auto error = find_crossing(solid, tree)) return std::move(*error);
  std::vector<std::uint32_t> surface_of;
  std::vector<bool> turned;
  if (!orient(solid, *other, surface_of, turned))
    return Error{ErrorCode::internal, "a surface without crossings is one-sided", {}};
  const std::vector<bool> touching = part_vertices(solid, *other);
  for (std::size_t f = 0; f < turned.size(); ++f)
    if (turned[f]) std::swap(solid.surface.faces[f][1], solid.surface.faces[f][2]);
  const std::uint32_t surfaces = *std::max_element(surface_of.begin(), surface_of.end()) + 1;
  const auto nested = nest(solid, tree, surface_of, surfaces, touching);
  if (!nested) return nested.error();
  const Nesting& nesting = *nested;
  for (std::size_t f = 0; f < turned.size(); ++f) {
    const std::uint32_t s = surface_of[f];
    const bool flip = nesting.outward[s] == (nesting.depth[s] % 2 == 1);
    if (flip) std::swap(solid.surface.faces[f][1], solid.surface.faces[f][2]);
    solid.report.reversed_faces += turned[f] != flip;
  }
  // Of a closed surface V - F / 2 = 2 - 2 genus; the tunnels of a solid are the genera of its
  // surfaces together.
  for (const std::uint32_t depth : nesting.depth)
    ++(depth % 2 == 0 ? solid.topology.components : solid.topology.cavities);
  solid.topology.tunnels = static_cast<std::int64_t>(surfaces) -
                           (static_cast<std::int64_t>(solid.surface.vertices.size()) -
                            static_cast<std::int64_t>(solid.surface.faces.size() / 2)) /
                               2;
  return solid;
}

}  // namespace

Result<Solid> build_solid(TriangleMesh mesh) {
  return guarded([&] { return make_solid(std::move(mesh)); });
}

}  // namespace medial

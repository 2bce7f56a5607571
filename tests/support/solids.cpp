#include "support/solids.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/vec3.h"

namespace medial::test {

TriangleMesh box_mesh(Vec3 low, Vec3 high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z});
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh sphere_mesh(Vec3 center, double radius, int levels) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) {
        const Vec3 sum = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(1 / norm(sum) * sum);
      }
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (const auto& [a, b, c] : mesh.faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      faces.push_back({a, ab, ca});
      faces.push_back({ab, b, bc});
      faces.push_back({ca, bc, c});
      faces.push_back({ab, bc, ca});
    }
    mesh.faces = std::move(faces);
  }
  return mapped(std::move(mesh), [=](Vec3 p) { return center + radius * p; });
}

TriangleMesh torus_mesh(double large, double small, int around, int across) {
  TriangleMesh mesh;
  const auto index = [=](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double ring = large + small * std::cos(v);
      mesh.vertices.push_back({ring * std::cos(u), ring * std::sin(u), small * std::sin(v)});
      mesh.faces.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.faces.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double height, int n) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, -height / 2}, {0, 0, height / 2}};
  for (int i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    for (const double z : {-height / 2, height / 2})
      mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), z});
    const auto low = static_cast<std::uint32_t>(2 + 2 * i);
    const auto next = static_cast<std::uint32_t>(2 + 2 * ((i + 1) % n));
    mesh.faces.push_back({0, next, low});
    mesh.faces.push_back({1, low + 1, next + 1});
    mesh.faces.push_back({low, next, next + 1});
    mesh.faces.push_back({low, next + 1, low + 1});
  }
  return mesh;
}

TriangleMesh cubes_mesh(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled) {
  TriangleMesh mesh;
  const auto is = [&](int x, int y, int z) {
    return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && filled(x, y, z);
  };
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        if (!is(x, y, z)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int side : {-1, 1}) {
            if (is(x + side * (axis == 0), y + side * (axis == 1), z + side * (axis == 2)))
              continue;
            Vec3 corner{double(x), double(y), double(z)}, u, v;
            corner[axis] += side > 0;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            if (side < 0) std::swap(u, v);
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const Vec3 p : {corner, corner + u, corner + u + v, corner + v})
              mesh.vertices.push_back(p);
            mesh.faces.push_back({first, first + 1, first + 2});
            mesh.faces.push_back({first, first + 2, first + 3});
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh letter_mesh(const std::vector<std::string>& rows, int height) {
  const int ny = static_cast<int>(rows.size()), nx = static_cast<int>(rows[0].size());
  return cubes_mesh(nx, ny, height, [&](int x, int y, int) {
    return rows[static_cast<std::size_t>(ny - 1 - y)][static_cast<std::size_t>(x)] == '#';
  });
}

TriangleMesh operator+(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.faces) a.faces.push_back({first + i, first + j, first + k});
  return a;
}

TriangleMesh mapped(TriangleMesh mesh, const std::function<Vec3(Vec3)>& map) {
  for (Vec3& vertex : mesh.vertices) vertex = map(vertex);
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh, double scale, Vec3 shift) {
  return mapped(std::move(mesh), [=](Vec3 p) {
    const double a = 0.7, b = 0.4;
    const Vec3 q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    const Vec3 r{q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z};
    return shift + scale * r;
  });
}

TriangleMesh unjoined(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const auto& face : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t vertex : face) result.vertices.push_back(mesh.vertices[vertex]);
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

}  // namespace medial::test

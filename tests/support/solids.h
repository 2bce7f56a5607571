#pragma once

// Closed meshes for tests. All are valid input for medial::build_solid() unless stated otherwise.

#include <functional>
#include <string>
#include <vector>

#include "medial/volume.h"

namespace medial::test {

/// A box of 12 faces.
TriangleMesh box_mesh(Vec3 low, Vec3 high);
/// An octahedron whose faces are halved along each side `levels` times, on a sphere: 8 * 4^levels.
TriangleMesh sphere_mesh(Vec3 center, double radius, int levels);
/// A torus around the z axis: circles of `small` radius around one of `large` radius.
TriangleMesh torus_mesh(double large, double small, int around, int across);
/// A prism over a regular polygon of n sides, around the z axis from -height / 2 to height / 2.
TriangleMesh cylinder_mesh(double radius, double height, int n);
/// The boundary of unit cubes at integer places, two faces a square; corners are not joined.
/// Cubes that share an edge or corner but no face make it touch itself.
TriangleMesh cubes_mesh(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled);
/// Cubes by rows of text, '#' filled, the first row at the largest y; `height` cubes along z.
TriangleMesh letter_mesh(const std::vector<std::string>& rows, int height);

/// Both meshes as one.
TriangleMesh operator+(TriangleMesh a, const TriangleMesh& b);
/// The mesh with each vertex put elsewhere.
TriangleMesh mapped(TriangleMesh mesh, const std::function<Vec3(Vec3)>& map);
/// Turned by a fixed, general rotation, then scaled and moved.
TriangleMesh turned(TriangleMesh mesh, double scale = 1, Vec3 shift = {});
/// Every face with corners of its own.
TriangleMesh unjoined(const TriangleMesh& mesh);

}  // namespace medial::test

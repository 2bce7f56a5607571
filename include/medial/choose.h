#pragma once

#include "medial/compute.h"

namespace medial {

/// Which of the methods that give the exact axis of this shape, all the same one, takes the least
/// processor time, by what was measured (docs/lee.md): `lee` for polygons of straight edges without
/// holes that are convex or nearly so, or smooth; `disks` for all others. Where compute() answers
/// `unsupported`, which some nearly round polygons with very many sides get, `disks` still takes
/// them. It does not depend on the number of threads. O(n).
Method choose_method(const Shape& shape, const Options& options);

}  // namespace medial

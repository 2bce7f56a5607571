#pragma once

// One question for a nasty shape: is its axis right, and the same under all symmetries?

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "medial/compute.h"
#include "support/nasty.h"

namespace medial::test {

enum class Fault : std::uint8_t {
  none,
  refused,      ///< invalid input: no fault
  internal,     ///< an error that no valid shape may end with
  unsupported,  ///< the same
  wrong,        ///< verify() is not content
  untrue,       ///< the graph is not the true one
  asymmetric,   ///< under a symmetry, or with two threads, the graph is another one
  loose,        ///< the same, up to ties within the tolerance or where arcs of one circle end
};
inline constexpr std::array all_faults{Fault::none,        Fault::refused, Fault::internal,
                                       Fault::unsupported, Fault::wrong,   Fault::untrue,
                                       Fault::asymmetric,  Fault::loose};
std::string_view name_of(Fault fault);

struct Finding {
  Fault fault = Fault::none;
  std::string words;
  bool compared = false;  ///< with the true graph
};

struct NastyOptions {
  Method method = method::Disks{};
  bool exact = false;   ///< Options::exact
  bool images = true;   ///< compare with mirror images and the like
  bool oracle = false;  ///< compare with true_graph(): a polygon of few sites
  bool planar = false;  ///< planar graphs of the same edges, and their diagrams
  bool points = false;  ///< beside their edges as well
};

Finding examine_nasty(const Rings& rings, const NastyOptions& options);
Finding examine_nasty(const std::vector<Chain>& chains, const NastyOptions& options);
/// Of the class's shape of a seed.
Finding examine_nasty(const NastyClass& one, std::uint64_t seed, bool small,
                      const NastyOptions& options);

/// The findings of many shapes.
struct Faults {
  std::map<Fault, std::uint64_t> counts;
  std::map<Fault, std::string> first;  ///< of each fault
  std::uint64_t compared = 0;

  void add(const Finding& finding);
  std::uint64_t count(Fault fault) const;
  std::uint64_t wrong() const;
};

/// A part of the rings with the same fault: points are left out as long as it stays.
Rings smallest_like(const Rings& rings, const Finding& finding, const NastyOptions& options);

}  // namespace medial::test

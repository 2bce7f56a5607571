#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "methods/exact/outline.h"

namespace medial::exact {

/// What was decided, and how.
struct Decisions {
  std::uint64_t filtered = 0;  ///< in double, by the bound of its errors
  std::uint64_t twofold = 0;   ///< in numbers of twice the digits, by the bound of their errors
  std::uint64_t precise = 0;   ///< in 256 bits, by the bound of their errors
  std::uint64_t rational = 0;  ///< in rational arithmetic with square roots
  std::uint64_t ties = 0;      ///< four sites that one disk touches: exactly true

  void add(const Decisions& other) {
    filtered += other.filtered;
    twofold += other.twofold;
    precise += other.precise;
    rational += other.rational;
    ties += other.ties;
  }
};

enum class Sign : std::int8_t {
  negative = -1,
  zero = 0,
  positive = 1,
  open,  ///< the numbers in use do not tell
  none,  ///< no disk touches them
};

/// For four sites that a disk, or nearly one, touches in this counter-clockwise order: whether
/// `fourth` stays outside the disk that touches the others (positive), touches it as well
/// (zero), or reaches into it. So of the two ways to divide the four among two disks, positive
/// stands for (first, second, third) and (first, third, fourth), and negative for the other one.
///
/// Always right: the filters in double, in twice its digits and in 256 bits decide by error bounds,
/// and what is left open is decided by rational arithmetic with square roots (exact/numbers.h).
/// Sites joined on the boundary are distinguished by the one that a disk's foot lies on, so the
/// disk is then one that touches their joint. Never `open`; `none` where the sites do not lie so.
Sign in_disk(const SiteLoops& outline, std::uint32_t first, std::uint32_t second,
             std::uint32_t third, std::uint32_t fourth, Decisions& decisions);

/// The disk that three sites touch in this counter-clockwise order and that is smaller than their
/// own circles, no two of the sites are joined. None where there is none, or that is open.
template <class Real>
std::optional<DiskBounds<Real>> disk_of_three(const SiteLoops& outline,
                                              const std::array<std::uint32_t, 3>& sites);

}  // namespace medial::exact

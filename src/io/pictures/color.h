#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace medial::io {

struct Color {
  double red = 0, green = 0, blue = 0;
};

inline constexpr Color paper_color{1, 1, 1};

// The colour map viridis (perceptually even, safe for colour-blind eyes), at 9 places; the last,
// light yellow, is left out because the axis lies on a light ground.
inline constexpr std::array<Color, 9> viridis{{{0.267, 0.005, 0.329},
                                               {0.283, 0.141, 0.458},
                                               {0.254, 0.265, 0.530},
                                               {0.207, 0.372, 0.553},
                                               {0.164, 0.471, 0.558},
                                               {0.128, 0.567, 0.551},
                                               {0.135, 0.659, 0.518},
                                               {0.267, 0.749, 0.441},
                                               {0.478, 0.821, 0.318}}};

inline constexpr int shade_count = 64;  ///< different colours

/// The colour of a share i / (shade_count - 1) of the largest radius.
inline Color shade(int i) {
  const double at = (viridis.size() - 1) * (static_cast<double>(i) / (shade_count - 1));
  const auto low = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double t = at - static_cast<double>(low);
  const Color& a = viridis[low];
  const Color& b = viridis[low + 1];
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue)};
}

}  // namespace medial::io

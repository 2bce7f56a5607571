#include "axis/statistics.h"

#include <algorithm>

namespace medial {

Statistics& operator+=(Statistics& sum, const Statistics& part) {
  for (const auto& [name, number] : statistics_counts) sum.*number += part.*number;
  for (const auto& [name, number] : statistics_times) sum.*number += part.*number;
  sum.largest_residual = std::max(sum.largest_residual, part.largest_residual);
  return sum;
}

}  // namespace medial

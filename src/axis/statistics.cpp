#include "axis/statistics.h"

#include <algorithm>

namespace medial {

Statistics& Statistics::operator+=(const Statistics& part) {
  for (const auto& [name, number] : statistics_counts) this->*number += part.*number;
  for (const auto& [name, number] : statistics_times) this->*number += part.*number;
  largest_residual = std::max(largest_residual, part.largest_residual);
  return *this;
}

}  // namespace medial

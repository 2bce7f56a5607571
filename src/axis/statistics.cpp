#include <algorithm>

#include "medial/axis.h"

namespace medial {

Statistics& Statistics::operator+=(const Statistics& part) {
  queries += part.queries;
  apollonius += part.apollonius;
  brackets += part.brackets;
  precision_retries += part.precision_retries;
  cuts += part.cuts;
  exact_filtered += part.exact_filtered;
  exact_precise += part.exact_precise;
  exact_rational += part.exact_rational;
  exact_ties += part.exact_ties;
  exact_changes += part.exact_changes;
  largest_residual = std::max(largest_residual, part.largest_residual);
  seconds_sites += part.seconds_sites;
  seconds_tree += part.seconds_tree;
  seconds_connect += part.seconds_connect;
  seconds_walk += part.seconds_walk;
  seconds_collect += part.seconds_collect;
  seconds_exact += part.seconds_exact;
  seconds += part.seconds;
  return *this;
}

}  // namespace medial

#pragma once

#include "medial/axis.h"

namespace medial {

/// Adds the counts and times of another part of the work. Does not change `threads`.
Statistics& operator+=(Statistics& sum, const Statistics& part);

/// A number of Statistics and its name in files.
template <class Number>
struct StatisticsField {
  const char* name;
  Number Statistics::*number;
};

/// All counts and all times, in order of declaration; not largest_residual and threads.
inline constexpr StatisticsField<std::uint64_t> statistics_counts[] = {
    {"queries", &Statistics::queries},
    {"apollonius", &Statistics::apollonius},
    {"brackets", &Statistics::brackets},
    {"precision_retries", &Statistics::precision_retries},
    {"cuts", &Statistics::bridges},
    {"exact_filtered", &Statistics::exact_filtered},
    {"exact_twofold", &Statistics::exact_twofold},
    {"exact_precise", &Statistics::exact_precise},
    {"exact_changes", &Statistics::exact_changes},
};
inline constexpr StatisticsField<double> statistics_times[] = {
    {"seconds_sites", &Statistics::seconds_sites},     {"seconds_tree", &Statistics::seconds_tree},
    {"seconds_connect", &Statistics::seconds_connect}, {"seconds_walk", &Statistics::seconds_walk},
    {"seconds_collect", &Statistics::seconds_collect}, {"seconds", &Statistics::seconds},
};

}  // namespace medial

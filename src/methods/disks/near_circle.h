#pragma once

#include "medial/axis.h"
#include "site/site.h"

namespace medial::disks {

/// Whether a disk is an arc's own circle, within `slack`: as round, and through both ends. Two arcs
/// on both sides of an apex, as curves have them, are small, and not that much alike.
bool is_own_circle(const site::Site& site, const Disk& disk, double slack);

}  // namespace medial::disks

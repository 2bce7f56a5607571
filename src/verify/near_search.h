// Finds the boundary edges that the disks of an axis edge may reach. distance_tree.cpp includes
// this file twice, for vectors of two and of four numbers, in namespaces that define Several and
// Each. GCC splits a vector of four numbers into two pairs in functions not compiled for wide
// registers.

/// A bound for all disks of an edge, with an allowance for rounding. Boundary edges are tested from
/// the centre of the larger disk at its ends.
class EdgeHull {
 public:
  EdgeHull(const DiskHull& disks, double slack) {
    const std::size_t larger = disks[0].radius > disks[2].radius ? 0 : 2;
    center_ = disks[larger].center;
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Disk& disk = disks[i == 0 ? larger : i == 1 ? 1 : 2 - larger];
      const Vec2 to = disk.center - center_;
      const double radius = (1 + 8 * epsilon) * (disk.radius + slack);
      corner_[i] = {to.x, to.y, radius, radius * radius};
      reach = std::max(reach, norm(to) + radius);
    }
    // A finite limit, so that the infinite bounds of empty sets are out of reach.
    limit_ = std::min((1 + 8 * epsilon) * reach * reach, std::numeric_limits<double>::max());
  }

  /// Whether a disk of finite size contains all of them.
  bool is_bounded() const { return limit_ < std::numeric_limits<double>::max(); }

  /// Whether disks may reach sets in their boxes. They do not if the box is out of reach from the
  /// centre, if all disks lie on one side of it, or if they all lie on the centre's side of the
  /// line through the place of the box nearest to the centre, perpendicular to the direction there.
  Each reaches(const Bounds& bounds, std::size_t set, Vec2 origin) const {
    const Several normal_x = several_at(bounds.normal_x + set),
                  normal_y = several_at(bounds.normal_y + set);
    const Several x = all_of(center_.x - origin.x), y = all_of(center_.y - origin.y);
    const Several from_along = normal_y * x - normal_x * y,
                  from_across = normal_x * x + normal_y * y;
    const Several low_along = several_at(bounds.low_along + set) - from_along;
    const Several high_along = several_at(bounds.high_along + set) - from_along;
    const Several low_across = several_at(bounds.low_across + set) - from_across;
    const Several high_across = several_at(bounds.high_across + set) - from_across;
    const Several along = smaller(larger(low_along, all_of(0)), high_along);
    const Several across = smaller(larger(low_across, all_of(0)), high_across);
    const Several square = along * along + across * across;
    const Each reached = square <= all_of(limit_);
    if (bits(reached & (square > 0)) == 0) return reached;
    Several last_along = all_of(corner_[0].radius), last_across = last_along;
    Several first_along = -last_along, first_across = first_along;
    Each ahead = square <= corner_[0].square;
    for (const Corner* corner : {&corner_[1], &corner_[2]}) {
      const Several at_along = normal_y * corner->x - normal_x * corner->y;
      const Several at_across = normal_x * corner->x + normal_y * corner->y;
      first_along = smaller(first_along, at_along - corner->radius);
      last_along = larger(last_along, at_along + corner->radius);
      first_across = smaller(first_across, at_across - corner->radius);
      last_across = larger(last_across, at_across + corner->radius);
      const Several away = larger(square - (along * at_along + across * at_across), all_of(0));
      ahead |= away * away <= corner->square * square;
    }
    return reached & ahead & (first_along <= high_along) & (last_along >= low_along) &
           (first_across <= high_across) & (last_across >= low_across);
  }

  /// Whether no disk reaches edges of a run. Except for the height of an arc, an edge lies beyond
  /// the line through the point of its chord nearest to the centre, or through its nearer end,
  /// perpendicular to the direction there.
  Each misses(const Run& run, std::size_t i) const {
    const Several start_x = several_at(run.start_x + i), start_y = several_at(run.start_y + i);
    const Several from_x = center_.x - start_x, from_y = center_.y - start_y;
    const Several along_x = several_at(run.end_x + i) - start_x;
    const Several along_y = several_at(run.end_y + i) - start_y;
    const Several square = along_x * along_x + along_y * along_y;
    // An edge without length is a point.
    const Several place = (from_x * along_x + from_y * along_y) / larger(square, all_of(smallest));
    const Several t = smaller(larger(place, all_of(0)), all_of(1));
    const Several off_x = from_x - t * along_x, off_y = from_y - t * along_y;
    const Several distance_2 = off_x * off_x + off_y * off_y;
    const Several to_start = off_x * from_x + off_y * from_y;
    const Several behind = smaller(to_start, to_start - (off_x * along_x + off_y * along_y));
    const Several height =
        0.5 * size_of(several_at(run.bulge + i)) * (size_of(along_x) + size_of(along_y));
    Each missed = distance_2 > 0;
    for (const Corner& corner : corner_) {
      const Several ahead = larger(behind + off_x * corner.x + off_y * corner.y, all_of(0));
      const Several reach = corner.radius + height;
      missed &= ahead * ahead > reach * reach * distance_2;
    }
    const Each straight = height == 0;
    if (bits(straight & ~missed) == 0) return missed;
    // Next to a convex corner, the line of a straight edge excludes more than the line through its
    // nearer end.
    const Several across = along_x * from_y - along_y * from_x,
                  side = with_sign_of(all_of(1), across);
    Each beside = straight & (square > 0);
    for (const Corner& corner : corner_) {
      const Several away =
          larger(side * (across + along_x * corner.y - along_y * corner.x), all_of(0));
      beside &= away * away > corner.square * square;
    }
    return missed | beside;
  }

 private:
  static constexpr double smallest = std::numeric_limits<double>::min();
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  Vec2 center_;
  double limit_;
  struct Corner {
    double x, y;  ///< from the centre
    double radius, square;
  };
  std::array<Corner, 3> corner_;  ///< the centre's first
};

/// Adds the edges of a run that disks may reach, each once.
inline void add_near(const EdgeHull& hull, const Run& run, std::uint32_t first, NearEdges& near) {
  const auto is_known = [&](std::uint32_t index) {
    for (std::size_t i = 0; i < near.size; ++i)
      if (near.index[i] == index) return true;
    return false;
  };
  for (std::uint32_t i = 0; i < fan_out; i += lanes)
    for (unsigned reached = bits(~hull.misses(run, i)); reached != 0; reached &= reached - 1) {
      const std::uint32_t k = i + static_cast<std::uint32_t>(__builtin_ctz(reached));
      if (near.size == near.most || is_known(run.index[k])) continue;
      near.place[near.size] = first + k;
      near.index[near.size++] = run.index[k];
    }
}

/// Adds the edges in wanted sets that disks may reach. Returns false if there are too many.
template <class Wanted>
inline bool find_near(const EdgeHull& hull, const std::vector<Run>& runs,
                      const std::vector<std::vector<Bounds>>& levels, Vec2 origin,
                      const Wanted& wanted, NearEdges& near) {
  constexpr int most_visits = 96;
  struct Set {
    std::uint32_t level, index;
  };
  Set stack[64];
  std::size_t size = 0;
  if (levels.empty())
    for (std::uint32_t run = 0; run < runs.size(); ++run)
      add_near(hull, runs[run], fan_out * run, near);
  else if (!hull.is_bounded())
    return false;
  else
    for (std::uint32_t i = 0; i < levels.back().size(); ++i)
      stack[size++] = {static_cast<std::uint32_t>(levels.size() - 1), i};
  for (int visits = 0; size > 0; ++visits) {
    if (visits == most_visits || near.size == near.most) return false;
    const Set set = stack[--size];
    const Bounds& bounds = levels[set.level][set.index];
    for (std::uint32_t i = 0; i < fan_out; i += lanes)
      for (unsigned reached = bits(hull.reaches(bounds, i, origin)); reached != 0;
           reached &= reached - 1) {
        const std::uint32_t k = i + static_cast<std::uint32_t>(__builtin_ctz(reached));
        if (!wanted(bounds, k)) continue;
        const std::uint32_t child = fan_out * set.index + k;
        if (set.level > 0)
          stack[size++] = {set.level - 1, child};
        else
          add_near(hull, runs[child], fan_out * child, near);
      }
  }
  return near.size < near.most;
}

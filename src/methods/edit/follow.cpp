#include <algorithm>
#include <cmath>
#include <utility>

#include "base/predicates.h"
#include "base/tolerance.h"
#include "methods/edit/parts.h"
#include "shape/limits.h"

namespace medial {

using edit::error_of;
using edit::join;

Error Editor::Parts::refusal(const Rings::Judgement& judgement) const {
  const std::uint32_t edge = touching ? touching->edge_at(judgement.edge, rings) : judgement.edge;
  Error error = judgement.verdict == Rings::Verdict::overlaps
                    ? error_of(ErrorCode::overlap, "edges would overlap", edge)
                    : error_of(ErrorCode::crossing, "edges would cross", edge);
  error.place.point = judgement.point;
  return error;
}

namespace {

/// Replaces -0 by 0, as build_shape() does.
void drop_signs_of_zeros(edit::Edit& edit) {
  constexpr double zero = 0;
  const auto drop = [](Vec2& p) { p = p + Vec2{zero, zero}; };
  drop(edit.place);
  for (double& bulge : edit.bulge) bulge += zero;
  for (edit::Corner& corner : edit.in) {
    drop(corner.point);
    corner.bulge += zero;
  }
}

}  // namespace

/// Whether the local coordinates of all new points are exact, and none is so small that compute()
/// may refuse it.
bool Editor::Parts::fits_frame(const edit::Edit& edit) const {
  const Vec2 furthest{std::max(std::abs(box.low.x), std::abs(box.high.x)),
                      std::max(std::abs(box.low.y), std::abs(box.high.y))};
  const double least = 4 * smallest_coordinate * std::max({1.0, furthest.x, furthest.y});
  const auto is_large = [&](double value) { return value == 0 || std::abs(value) >= least; };
  const auto fits = [&](Vec2 place) {
    const Vec2 local = rings.frame().to_local(place);
    constexpr double largest = 2;
    return is_large(place.x) && is_large(place.y) && std::abs(local.x) < largest &&
           std::abs(local.y) < largest && rings.frame().to_input(local) == place;
  };
  return (edit.fresh == none || fits(edit.place)) &&
         std::all_of(edit.in.begin(), edit.in.end(),
                     [&](const edit::Corner& corner) { return fits(corner.point); });
}

std::optional<Error> Editor::Parts::refuse(const edit::Edit& edit, const Rings& own) {
  const auto is_finite = [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  const char* const not_finite = "a coordinate or a bulge is not finite";
  if (edit.is_of_loops()) {
    for (const edit::Corner& corner : edit.in)
      if (!is_finite(corner.point) || !std::isfinite(corner.bulge))
        return error_of(ErrorCode::not_finite, not_finite, corner.number);
    if (edit.out.empty() || !edit.in.empty()) return std::nullopt;
    const std::uint32_t hole = own.hole_in(own[edit.out.front().number].loop);
    if (hole == none) return std::nullopt;
    return error_of(ErrorCode::hole_outside, "the hole would not lie inside an outer ring", hole);
  }
  const std::uint32_t shown = edit.fresh != none ? edit.fresh : edit.old;
  if (!std::isfinite(edit.bulge[0]) || !std::isfinite(edit.bulge[1]) ||
      (edit.fresh != none && !is_finite(edit.place)))
    return error_of(ErrorCode::not_finite, not_finite, shown);
  const std::uint32_t fewest = edit.bulge[0] == 0 && !own.has_arcs() ? 3 : 2;
  if (edit.fresh == none && own.loop_size(own[edit.before].loop) <= fewest)
    return error_of(ErrorCode::too_few_points, "a loop needs three vertices, or two with arcs",
                    shown);
  return std::nullopt;
}

Result<AxisChange> Editor::Parts::change(edit::Edit edit) {
  drop_signs_of_zeros(edit);
  if (auto error = refuse(edit, edited())) return std::move(*error);
  if (!edit.seat && !edit.out.empty() && !edit.in.empty()) {
    // A loop that has holes stays an outer loop.
    const std::uint32_t loop = edited()[edit.out.front().number].loop;
    if (edited().hole_in(loop) != none) edit.seat = edited().seat_of(loop);
  }
  // With arcs, edges closer than the tolerance touch and are merged.
  const bool is_first_or_last_arc = edited().has_arcs_after(edit) != rings.has_arcs();
  const bool is_exact = !edit.is_of_loops() && !rings.has_arcs();
  if (is_first_or_last_arc || (!is_exact && !fits_frame(edit))) return rebuild(edit);
  const std::optional<edit::Edit> own = touching ? touching->of_loops(edit, rings) : edit;
  Rings::Judgement judgement{Rings::Verdict::unclear, none, {}};
  if (own) judgement = rings.judge(*own);
  std::optional<edit::Contacts> contacts;
  if (judgement.verdict == Rings::Verdict::unclear && !edit.is_of_loops() && !rings.has_arcs()) {
    contacts = edit::find_contacts(rings, detour_of(edit));
    if (contacts->judgement.verdict != Rings::Verdict::keeps_form) judgement = contacts->judgement;
  }
  if (judgement.verdict != Rings::Verdict::keeps_form &&
      judgement.verdict != Rings::Verdict::unclear)
    return refusal(judgement);
  if (!fits_frame(edit) || straightens_crossing(edit)) return rebuild(edit);
  edit::Edit back = edited().inverse(edit);
  edit::make_room(inverse, inverse.size() + 1);
  Result<std::optional<Step>> step = std::optional<Step>();
  const bool touches = contacts && contacts->judgement.verdict == Rings::Verdict::keeps_form;
  if (own && !touches) step = follow(edit, *own, judgement.verdict);
  if (!step) return std::move(step).error();
  if (!*step && contacts) step = weave(edit, *contacts);
  if (!*step && !edit.is_of_loops()) step = replace_loop(edit);
  std::optional<Error> refused;
  if (!*step && edit.is_of_loops() && !rings.has_arcs()) step = weave_loops(edit, refused);
  if (refused) return std::move(*refused);
  if (!*step) return rebuild(edit);
  inverse.push_back(std::move(back));
  AxisChange& change = (*step)->change;
  change.vertex = subject_of(edit);
  constexpr double shrunk = 16;
  if (shrunk * diagonal(rings.box()) < diagonal(box)) refine(change);
  return std::move(change);
}

/// Applies an edit of the rings that corresponds to the edit `own` of the loops.
Result<std::optional<Step>> Editor::Parts::follow(const edit::Edit& edit,
                                                  const edit::Edit& of_loops,
                                                  Rings::Verdict verdict) {
  if (!touching) return follow(of_loops, verdict);
  const edit::Edit back = edited().inverse(edit);
  edit::Edit drawn = edit;
  if (edit.out.empty() && !edit.in.empty() && !edit.seat) {
    const std::uint32_t site = rings.around(edit.in.front().point).site;
    drawn.seat = touching->seat_beside(site == none ? none : Rings::vertex_of(site), rings);
  }
  touching->apply(drawn, rings);
  Result<std::optional<Step>> step = std::optional<Step>();
  try {
    step = follow(of_loops, verdict);
  } catch (...) {
    touching->rings().apply(back, false);
    throw;
  }
  if (step && *step)
    touching->note(edit, of_loops);
  else
    touching->rings().apply(back, false);
  return step;
}

/// Applies an edit of the loops. Returns none, and changes nothing, if the whole axis must be
/// recomputed.
Result<std::optional<Step>> Editor::Parts::follow(const edit::Edit& edit, Rings::Verdict verdict) {
  const Box old_box = box;
  Box reach = box;
  rings.add_reach(edit, reach);
  set_box(reach);
  std::optional<Error> refused;
  auto step = verdict == Rings::Verdict::unclear ? follow_in_two(edit, refused) : follow(edit);
  if (!step) set_box(old_box);
  if (refused) return std::move(*refused);
  return step;
}

void Editor::Parts::set_box(const Box& other) {
  box = other;
  measures.radius_limit = radius_limit(box, rings.frame());
}

/// Recomputes everything after the shape, and with it the tolerance, has become much smaller. If
/// that fails, the axis stays as it is.
void Editor::Parts::refine(AxisChange& change) {
  Parts next = *this;
  if (!next.start_again()) return;
  AxisChange then;
  list_all(then.removed_nodes, then.removed_edges);
  next.list_all(then.added_nodes, then.added_edges);
  join(change, then);
  change.everything = true;
  *this = std::move(next);
}

Result<AxisChange> Editor::Parts::undo() {
  if (inverse.empty()) return AxisChange{};
  const Rings& own = edited();
  edit::Edit last = inverse.back();
  // build_shape() may have reversed the loop since. In a loop of two vertices, each follows the
  // other.
  const auto is_turned = [&] {
    const Rings::Vertex& before = own[last.before];
    return before.next != (last.old != none ? last.old : last.after) ||
           (own.loop_size(before.loop) == 2 && before.bulge != last.bulge_before);
  };
  if (!last.is_of_loops() && is_turned()) {
    std::swap(last.before, last.after);
    const auto [first, second] = last.bulge;
    if (last.fresh != none)
      last.bulge = {-second, -first};
    else
      last.bulge = {-first, 0};
  }
  auto result = change(last);
  if (!result) return result;
  inverse.pop_back();  // the entry that change() added
  inverse.pop_back();
  return result;
}

/// Finds the sites whose disks an edit removes, and the nodes around the place of an insertion.
/// Call it before the edit is applied.
Editor::Parts::Seeds Editor::Parts::seeds_of(const edit::Edit& edit) const {
  Seeds seeds;
  seeds.before = rings.sites_around(edit);
  const auto has_edges = [&](std::uint32_t site) {
    bool has = false;
    graph.for_edges_of_site(site, [&](std::uint32_t, std::size_t) { has = true; });
    return has;
  };
  // An arc may have no edges: its disk is then a node at which its neighbours' edges end.
  for (const Rings::Extent& one : seeds.before) {
    if (has_edges(one.site)) continue;
    std::uint32_t after = one.site, before = one.site;
    do after = rings.next_site(after);
    while (after != one.site && !has_edges(after));
    do before = rings.site_before(before);
    while (before != one.site && !has_edges(before));
    seeds.sites.insert(seeds.sites.end(), {after, before});
  }
  if (!edit.out.empty()) {
    const bool is_hole = rings.is_hole(rings[edit.out.front().number].loop);
    seeds.parts += is_hole ? 1 : -1;
    seeds.is_whole_part = !is_hole;
  }
  if (!edit.in.empty()) add_seeds_around(edit.in.front().point, seeds);
  return seeds;
}

/// The disk that touches the site nearest to a place, grown until it is maximal, contains the
/// place. So that disk is on an edge of this site.
void Editor::Parts::add_seeds_around(Vec2 place, Seeds& seeds) const {
  const std::uint32_t site = rings.around(place).site;
  seeds.parts += site == none ? 1 : -1;
  seeds.is_whole_part = site == none;
  if (site != none) seeds.sites.push_back(site);
}

/// Applies an edit that keeps the form of all loops, and repairs the axis. Returns none, and
/// changes nothing, if the whole axis must be recomputed.
std::optional<Step> Editor::Parts::follow(const edit::Edit& edit) {
  const Seeds seeds = seeds_of(edit);
  const edit::Edit back = rings.inverse(edit);
  rings.apply(edit);
  std::optional<Step> step;
  try {
    step = seeds.is_whole_part
               ? repair_part(edit, seeds)
               : repair(seeds, rings.sites_around(edit), edit.old == edit.fresh ? edit.old : none);
  } catch (...) {
    rings.apply(back);
    throw;
  }
  if (!step) rings.apply(back);
  return step;
}

/// Removes a vertex that jumps across others, or a loop, and inserts it again at its new place.
/// Returns none, and changes nothing, if one of the two steps changes the form of a loop or makes
/// edges cross.
std::optional<Step> Editor::Parts::follow_in_two(const edit::Edit& edit,
                                                 std::optional<Error>& refused) {
  edit::Edit out{edit.before, edit.after, edit.old, none, {}, {}, edit.out, {}};
  edit::Edit in{edit.before, edit.after, none,    edit.fresh, edit.place,
                edit.bulge,  {},         edit.in, edit.seat};
  const bool has_two = edit.is_of_loops() ? !edit.out.empty() && !edit.in.empty()
                                          : edit.old == edit.fresh && !refuse(out, rings);
  if (!has_two || rings.judge(out).verdict != Rings::Verdict::keeps_form) return std::nullopt;
  const edit::Edit back = rings.inverse(out);
  std::optional<Step> first = follow(out), second;
  if (!first) return std::nullopt;
  const auto take_back = [&] {
    put_back(*first);
    rings.apply(back);
  };
  try {
    const Rings::Judgement judgement = rings.judge(in);
    if (judgement.verdict == Rings::Verdict::keeps_form) second = follow(in);
    if (edit.is_of_loops() && judgement.verdict == Rings::Verdict::crosses)
      refused = refusal(judgement);
    if (second) {
      // In a copy: if memory runs out halfway, put_back() still needs the first change as it was.
      AxisChange both = first->change;
      join(both, second->change);
      first->change = std::move(both);
    }
  } catch (...) {
    if (second) {
      put_back(*second);
      rings.apply(out);
    }
    take_back();
    throw;
  }
  if (second) return first;
  take_back();
  return std::nullopt;
}

/// Finds the part that changes, and computes its new axis. None if the whole axis must be
/// recomputed.
std::optional<Step> Editor::Parts::repair(const Seeds& seeds,
                                          const std::vector<Rings::Extent>& after,
                                          std::uint32_t moved) {
  constexpr double margin = 64;  // tolerances
  constexpr int most_rounds = 16;
  edit::Spread spread(graph, marks, ++mark);
  const std::vector<Rings::Extent>& before = seeds.before;
  const auto stays_in = [&](const Rings::Extent& one, const std::vector<Rings::Extent>& others) {
    const bool moves = moved != none && (one.site / 2 == moved || one.end == moved);
    return !moves && std::find(others.begin(), others.end(), one) != others.end();
  };
  bool changes = false;
  for (const Rings::Extent& one : before) {
    if (stays_in(one, after)) continue;
    spread.add_site(one.site);
    changes = true;
  }
  std::vector<site::Site> fresh;
  std::vector<std::uint32_t> loops;
  for (const Rings::Extent& one : after) {
    if (stays_in(one, before)) continue;
    rings.add_pieces(one.site, fresh);
    loops.push_back(rings[one.site / 2].loop);
    changes = true;
  }
  if (!changes) return Step{};
  for (const std::uint32_t site : seeds.sites) spread.add_site(site);
  for (int round = 0; round < most_rounds; ++round) {
    spread.spread(fresh, margin * measures.tolerance);
    const edit::Affected affected = spread.result();
    if (affected.nodes.size() == graph.node_count()) return std::nullopt;
    const auto windows =
        edit::windows_of(rings, graph, affected, loops, seeds.parts, measures.radius_limit);
    if (!windows) return std::nullopt;
    std::vector<std::uint32_t> doubtful;
    if (const auto found = repair(*windows, doubtful))
      return replace(affected, *found, seeds.parts);
    if (doubtful.empty()) return std::nullopt;
    for (const std::uint32_t node : doubtful) spread.add_around(node, std::size_t{1} << round);
  }
  return std::nullopt;
}

/// Computes the new parts of the axis in some windows.
std::optional<edit::Repair> Editor::Parts::repair(const std::vector<edit::Window>& windows,
                                                  std::vector<std::uint32_t>& doubtful) const {
  edit::Repair all;
  for (const edit::Window& window : windows) {
    const auto one = window.borders.empty()
                         ? axis_of_loops(window.loops)
                         : edit::repair(rings, graph, window, measures, doubtful);
    if (!one) return std::nullopt;
    const auto first = static_cast<std::uint32_t>(all.disks.size());
    all.disks.insert(all.disks.end(), one->disks.begin(), one->disks.end());
    all.old_nodes.insert(all.old_nodes.end(), one->old_nodes.begin(), one->old_nodes.end());
    for (AxisGraph::Edge edge : one->edges) {
      for (std::uint32_t& node : edge.node) node += first;
      all.edges.push_back(edge);
    }
  }
  return all;
}

/// Adds or removes the whole axis of an outer loop without holes.
std::optional<Step> Editor::Parts::repair_part(const edit::Edit& edit, const Seeds& seeds) {
  edit::Spread spread(graph, marks, ++mark);
  for (const Rings::Extent& one : seeds.before) spread.add_site(one.site);
  for (const std::uint32_t site : seeds.sites) spread.add_site(site);
  spread.spread({}, 0);
  const edit::Affected affected = spread.result();
  if (!affected.borders.empty()) return std::nullopt;
  if (edit.in.empty()) return replace(affected, {}, seeds.parts);
  const auto found = axis_of_loops({rings[edit.in.front().number].loop});
  if (!found) return std::nullopt;
  return replace(affected, *found, seeds.parts);
}

/// The axis of a component.
std::optional<edit::Repair> Editor::Parts::axis_of_loops(
    const std::vector<std::uint32_t>& loops) const {
  Shape shape = rings.shape_of(loops);
  for (Vec2& p : shape.points) p = rings.frame().to_local(p);
  std::vector<std::uint32_t> vertices;
  for (VertexSource& source : shape.sources) {
    vertices.push_back(source.vertex);
    source = {0, static_cast<std::uint32_t>(vertices.size() - 1)};
  }
  Options own = options;
  own.tolerance = relative_tolerance(measures.tolerance, bounding_box(shape));
  const auto axis = edit::local_axis(shape, own, rings.frame().scale * rings.joining().tolerance);
  if (!axis || axis->tolerance > 2 * measures.tolerance) return std::nullopt;
  edit::Repair repair;
  for (const medial::Node& node : axis->nodes) repair.disks.push_back(node.disk);
  repair.old_nodes.assign(repair.disks.size(), none);
  const auto number_of = [&](std::uint32_t i) {
    const Site& site = axis->sites[i];
    return 2 * vertices[site.vertex] + (site.kind() == SiteKind::vertex ? 0 : 1);
  };
  for (const medial::Edge& edge : axis->edges)
    repair.edges.push_back(
        {edge.node, {number_of(edge.site[0]), number_of(edge.site[1])}, edge.control, edge.weight});
  return repair;
}

/// Replaces the old part of the axis by the new one. Returns none, and changes nothing, if the
/// number of parts less cycles would not grow by `parts`.
std::optional<Step> Editor::Parts::replace(const edit::Affected& affected,
                                           const edit::Repair& repair, int parts) {
  const auto fresh =
      static_cast<std::size_t>(std::count(repair.old_nodes.begin(), repair.old_nodes.end(), none));
  const auto signed_size = [](std::size_t size) { return static_cast<std::ptrdiff_t>(size); };
  if (signed_size(fresh + affected.edges.size()) !=
      signed_size(affected.nodes.size() + repair.edges.size()) + parts)
    return std::nullopt;
  // Only this part may run out of memory.
  std::vector<std::uint32_t> number = repair.old_nodes;
  Step step;
  AxisChange& change = step.change;
  for (const std::uint32_t node : affected.nodes) step.nodes.push_back(graph.disk(node));
  for (const std::uint32_t edge : affected.edges) step.edges.push_back(graph.edge(edge));
  change.removed_nodes = affected.nodes;
  change.removed_edges = affected.edges;
  change.added_nodes.reserve(fresh);
  change.added_edges.reserve(repair.edges.size());
  graph.make_room(fresh, repair.edges.size(), 2 * rings.size());
  for (const std::uint32_t edge : affected.edges) graph.remove_edge(edge);
  for (const std::uint32_t node : affected.nodes) graph.remove_node(node);
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == none)
      change.added_nodes.push_back(number[i] = graph.add_node(repair.disks[i]));
  for (AxisGraph::Edge edge : repair.edges) {
    for (std::uint32_t& node : edge.node) node = number[node];
    change.added_edges.push_back(graph.add_edge(edge));
  }
  return step;
}

/// Undoes the last replace(). Removing and adding in reverse order restores all numbers.
void Editor::Parts::put_back(const Step& step) {
  const AxisChange& change = step.change;
  for (auto i = change.added_edges.rbegin(); i != change.added_edges.rend(); ++i)
    graph.remove_edge(*i);
  for (auto i = change.added_nodes.rbegin(); i != change.added_nodes.rend(); ++i)
    graph.remove_node(*i);
  for (auto i = step.nodes.rbegin(); i != step.nodes.rend(); ++i) graph.add_node(*i);
  for (auto i = step.edges.rbegin(); i != step.edges.rend(); ++i) graph.add_edge(*i);
}

}  // namespace medial

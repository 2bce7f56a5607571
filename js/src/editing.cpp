// Axes that follow edits of their shapes.

#include <cstring>

#include "binding.h"

namespace medial::js {
namespace {

/// Records, as they are in memory, as a table.
template <class T>
std::vector<double> bytes_of(const std::vector<T>& records) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  std::vector<double> table(records.size() * (sizeof(T) / sizeof(double)));
  if (!records.empty()) std::memcpy(table.data(), records.data(), records.size() * sizeof(T));
  return table;
}

/// The records with these numbers, from a function of the editor.
template <class T, class Get>
int answer_those(const std::uint32_t* numbers, std::size_t count, const Get& get) {
  return answered([&] {
    std::vector<T> found;
    found.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<T> one = get(numbers[i]);
      if (!one)
        refuse(ErrorCode::invalid_option, "there is no number " + std::to_string(numbers[i]));
      found.push_back(*one);
    }
    answer().tables = {bytes_of(found)};
    return 1;
  });
}

/// The vertex, whether everything was recomputed, and the numbers of what an edit has changed.
template <class Work>
int answer_change(const Work& work) {
  return answered([&] {
    const AxisChange change = value_of(work());
    answer().tables = {{number(change.vertex), number(change.everything)}};
    for (const auto* numbers :
         {&change.removed_nodes, &change.removed_edges, &change.added_nodes, &change.added_edges})
      answer().tables.emplace_back(numbers->begin(), numbers->end());
    return 1;
  });
}

}  // namespace

MEDIAL_JS Editor* medial_editor(const ShapeOf* of, double tolerance) {
  return answered([&] {
    Options options;
    options.tolerance = tolerance;
    return new Editor(value_of(Editor::make(*of->shape, options)));
  });
}
MEDIAL_JS Editor* medial_editor_copy(const Editor* editor) {
  return answered([&] { return new Editor(*editor); });
}
MEDIAL_JS void medial_free_editor(Editor* editor) { delete editor; }

MEDIAL_JS int medial_editor_move(Editor* editor, std::uint32_t vertex, double x, double y) {
  return answer_change([&] { return editor->move(vertex, {x, y}); });
}
MEDIAL_JS int medial_editor_insert(Editor* editor, std::uint32_t before, double x, double y) {
  return answer_change([&] { return editor->insert(before, {x, y}); });
}
MEDIAL_JS int medial_editor_remove(Editor* editor, std::uint32_t vertex) {
  return answer_change([&] { return editor->remove(vertex); });
}
MEDIAL_JS int medial_editor_set_bulge(Editor* editor, std::uint32_t vertex, double bulge) {
  return answer_change([&] { return editor->set_bulge(vertex, bulge); });
}
/// `bulges`: as many as points, or null.
MEDIAL_JS int medial_editor_insert_loop(Editor* editor, const double* coordinates,
                                        std::size_t count, const double* bulges) {
  return answer_change([&] {
    Ring ring;
    for (std::size_t i = 0; i < count; ++i)
      ring.points.push_back({coordinates[2 * i], coordinates[2 * i + 1]});
    if (bulges != nullptr) ring.bulges.assign(bulges, bulges + count);
    return editor->insert_loop(ring);
  });
}
MEDIAL_JS int medial_editor_remove_loop(Editor* editor, std::uint32_t vertex) {
  return answer_change([&] { return editor->remove_loop(vertex); });
}
MEDIAL_JS int medial_editor_move_loop(Editor* editor, std::uint32_t vertex, double x, double y) {
  return answer_change([&] { return editor->move_loop(vertex, {x, y}); });
}
MEDIAL_JS int medial_editor_undo(Editor* editor) {
  return answer_change([&] { return editor->undo(); });
}

/// x, y and the bulge of the edge after the vertex; nothing if it does not exist.
MEDIAL_JS int medial_editor_vertex(const Editor* editor, std::uint32_t vertex) {
  return answered([&] {
    answer().tables.emplace_back();
    if (const auto place = editor->vertex(vertex))
      answer().tables[0] = {place->x, place->y, *editor->bulge(vertex)};
    return 1;
  });
}
MEDIAL_JS int medial_editor_nodes(const Editor* editor, const std::uint32_t* numbers,
                                  std::size_t count) {
  return answer_those<Node>(numbers, count, [&](std::uint32_t i) { return editor->node(i); });
}
MEDIAL_JS int medial_editor_edges(const Editor* editor, const std::uint32_t* numbers,
                                  std::size_t count) {
  return answer_those<Edge>(numbers, count, [&](std::uint32_t i) { return editor->edge(i); });
}
MEDIAL_JS int medial_editor_sites(const Editor* editor, const std::uint32_t* numbers,
                                  std::size_t count) {
  return answer_those<Site>(numbers, count, [&](std::uint32_t i) { return editor->site(i); });
}

MEDIAL_JS AxisOf* medial_editor_axis(const Editor* editor) {
  return answered(
      [&] { return new_axis(std::make_shared<const Shape>(editor->shape()), editor->axis()); });
}

}  // namespace medial::js

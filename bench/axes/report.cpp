#include "report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "peers.h"

namespace medial::bench {

namespace {

double microseconds(double seconds, const MedialFigures& of) {
  return 1e6 * seconds / static_cast<double>(of.vertices);
}

std::string peer_cells(const std::optional<PeerFigures>& peer, const MedialFigures& own) {
  if (!peer) return "| - | - ";
  return fmt::format("| {:.2f} | {:.1f} ", microseconds(peer->seconds, own),
                     peer->seconds / own.seconds);
}

/// How a table calls the growth of a family, if it is one that grows.
std::string growth_of(const std::vector<Row>& rows, Family family, const char* name) {
  const Row* small = nullptr;
  const Row* large = nullptr;
  for (const Row& row : rows) {
    if (row.input.family != family || !row.medial) continue;
    if (row.input.vertices > 5000 && row.input.vertices < 50000) small = &row;
    if (row.input.vertices > 500000) large = &row;
  }
  if (!small || !large) return "";
  const auto cost = [](const Row& row) { return microseconds(row.medial->seconds, *row.medial); };
  const auto whole = [](const Row& row) {
    return microseconds(row.medial->seconds + row.medial->shape_seconds, *row.medial);
  };
  return fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name, cost(*small),
                     cost(*large), cost(*large) / cost(*small), whole(*large) / whole(*small));
}

}  // namespace

std::string header_lines() {
  return fmt::format(
      "| input | vertices | medial us/vertex | 2 threads, times faster | at most, by two copies at "
      "once | Boost {} us/vertex | "
      "Boost / medial | Boost, not stretched, us/vertex | ratio | CGAL {} us/vertex | CGAL / "
      "medial | build_shape us/vertex | "
      "peak bytes/vertex | queries/site | precision retries | residual / diagonal |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      boost_version(), cgal_version());
}

std::string line_of(const Row& row) {
  if (!row.medial) return fmt::format("| {} | - | {} |\n", row.input.name, row.medial_note);
  const MedialFigures& own = *row.medial;
  return fmt::format(
      "| {} | {} | {:.2f} | {:.2f} | {:.2f} {}{}{}| {:.2f} | {:.0f} | {:.2f} | {:.0f} | {:.1e} |\n",
      row.input.name, own.vertices, microseconds(own.seconds, own),
      own.one_thread_wall / own.two_threads_wall, 2 * own.one_thread_wall / own.two_copies_wall,
      peer_cells(row.boost, own), peer_cells(row.boost_unstretched, own), peer_cells(row.cgal, own),
      microseconds(own.shape_seconds, own), own.peak_bytes / static_cast<double>(own.vertices),
      own.queries_per_site, own.precision_retries, own.largest_residual);
}

std::string summary_of(const std::vector<Row>& rows) {
  const std::string growth = growth_of(rows, Family::coast, "coast") +
                             growth_of(rows, Family::smooth, "blob") +
                             growth_of(rows, Family::maze, "maze");
  std::string text;
  if (!growth.empty()) {
    text +=
        "\n| growth | us/vertex at 1e4 | at 1e6 | compute, ratio | with build_shape, ratio |\n"
        "|---|--:|--:|--:|--:|\n" +
        growth;
  }
  std::string notes;
  for (const Row& row : rows) {
    const auto note = [&](const char* who, const std::string& what) {
      if (!what.empty()) notes += fmt::format("- {}, {}: {}\n", row.input.name, who, what);
    };
    note("medial", row.medial_note);
    note("Boost", row.boost_note);
    note("CGAL", row.cgal_note);
    if (row.boost && row.boost->left_out > 0) {
      note("Boost", fmt::format("{} segments have no length in int32 coordinates and were left out",
                                row.boost->left_out));
    }
  }
  text +=
      "\nTimes of one thread are processor time, medians. Boost's coordinates are stretched to the "
      "range of int32; \"not stretched\" takes the input's own integers (coasts: 1e-6 degrees), "
      "which is faster, and exact.\n";
  if (!notes.empty()) text += "\n" + notes;
  return text;
}

std::string json_of(const std::vector<Row>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json item{{"input", row.input.name}};
    if (row.medial) {
      const MedialFigures& own = *row.medial;
      item["vertices"] = own.vertices;
      item["medial"] = {{"seconds", own.seconds},
                        {"seconds_shape", own.shape_seconds},
                        {"seconds_wall_1_thread", own.one_thread_wall},
                        {"seconds_wall_2_threads", own.two_threads_wall},
                        {"seconds_wall_2_copies", own.two_copies_wall},
                        {"peak_bytes", own.peak_bytes},
                        {"queries_per_site", own.queries_per_site},
                        {"precision_retries", own.precision_retries},
                        {"largest_residual", own.largest_residual}};
    }
    if (row.boost) item["boost"] = {{"seconds", row.boost->seconds}};
    if (row.boost_unstretched) {
      item["boost_unstretched"] = {{"seconds", row.boost_unstretched->seconds}};
    }
    if (row.cgal) item["cgal"] = {{"seconds", row.cgal->seconds}};
    for (const auto& [key, note] : {std::pair{"medial_note", &row.medial_note},
                                    {"boost_note", &row.boost_note},
                                    {"cgal_note", &row.cgal_note}}) {
      if (!note->empty()) item[key] = *note;
    }
    list.push_back(std::move(item));
  }
  return nlohmann::ordered_json{
             {"boost", boost_version()}, {"cgal", cgal_version()}, {"rows", std::move(list)}}
             .dump(2) +
         "\n";
}

}  // namespace medial::bench

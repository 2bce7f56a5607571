// medial methods: the table of methods.

#include "medial/methods.h"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"

namespace medial::cli {
namespace {

Json json_of(const MethodInfo& info) {
  return {{"name", info.name},         {"summary", info.summary}, {"exact", info.exact()},
          {"exterior", info.exterior}, {"part", info.part},       {"contours", info.contours},
          {"threads", info.threads}};
}

std::string table_of_methods() {
  std::string text =
      "| method | how | axes | exterior | a part | threads |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  const auto mark = [](bool yes) { return yes ? "yes" : "-"; };
  for (const MethodInfo& info : methods()) {
    const char* axes = info.exact() ? "exact" : "sampled";
    if (info.sampling == Sampling::pixels) axes = "pixels";
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", info.name, info.summary, axes,
                        mark(info.exterior), mark(info.part), mark(info.threads));
  }
  return text;
}

Result<int> run_methods(bool json) {
  Json list = Json::array();
  for (const MethodInfo& info : methods()) list.push_back(json_of(info));
  Status printed = json ? print(Json{{"methods", std::move(list)}}) : print(table_of_methods());
  if (!printed) return std::move(printed).error();
  return exit_success;
}

}  // namespace

Command make_methods_command(CLI::App& program) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand("methods", "List the methods and what each supports.");
  command->add_flag("--json", *json, "Print a JSON object instead of a table.");
  return {command, [json] { return run_methods(*json); }};
}

}  // namespace medial::cli

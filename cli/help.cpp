// Help pages, `medial help`, and errors of command lines that cannot be parsed.

#include "cli/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <sstream>
#include <string_view>

#include "cli/commands.h"

namespace medial::cli {
namespace {

constexpr std::size_t first_column = 27;
constexpr std::size_t line_width = 80;

/// Groups of options that pages list by name only: those of many commands or of one method.
bool is_folded(const std::string& group) {
  constexpr std::array shared = {input_group,
                                 curve_group,
                                 picture_group,
                                 common_group,
                                 std::string_view("Units"),
                                 std::string_view("Clearing before a V"),
                                 std::string_view("Tabs")};
  return std::ranges::find(shared, group) != shared.end() ||
         group.find("(--method") != std::string::npos;
}

/// CLI11's help in another order, with `--repair[=RULE]`, `--close[=GAP]` and `--specks[=SHARE]`
/// for flags that may carry a value.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(first_column); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    if (app->get_parent() == nullptr) return CLI::Formatter::make_help(app, name, mode);
    const std::string footer = app->get_footer();
    const std::size_t end = std::min(footer.find("Examples:\n"), footer.size());
    std::string text = app->get_description() + "\n" + make_usage(app, name);
    if (end < footer.size()) text += "\n" + footer.substr(end) + "\n";
    text += make_positionals(app) + make_options(app, mode == CLI::AppFormatMode::Normal);
    const std::string notes = CLI::detail::trim_copy(footer.substr(0, end));
    return notes.empty() ? text : text + "\n" + notes + "\n";
  }

  std::string make_subcommand(const CLI::App* app) const override {
    std::stringstream out;
    CLI::detail::format_help(out, app->get_name(), app->get_description(), first_column);
    return out.str();
  }

  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    const auto brace = name.find('{');
    if (brace == std::string::npos) return name;
    const bool negative = name.find("{false}") == brace;
    name.resize(brace);
    if (negative) return name;
    return name + (name == "--close" ? "[=GAP]" : name == "--specks" ? "[=SHARE]" : "[=RULE]");
  }

 private:
  std::string make_options(const CLI::App* app, bool fold) const {
    std::string described, folded;
    std::vector<std::string> groups = app->get_groups();
    std::stable_partition(groups.begin(), groups.end(),
                          [](const std::string& group) { return group != common_group; });
    for (const std::string& group : groups) {
      const auto options = app->get_options([&group](const CLI::Option* option) {
        return option->nonpositional() && option->get_group() == group;
      });
      if (group.empty() || options.empty()) continue;
      if (fold && is_folded(group))
        folded += make_names(group, options);
      else
        described += make_group(group, false, options);
    }
    return folded.empty() ? described
                          : described + "\nMore options, described by --help-all:\n" + folded;
  }

  std::string make_names(std::string label, const std::vector<const CLI::Option*>& options) const {
    label.resize(std::min(label.find(" ("), label.size()));
    std::string text, line = fmt::format("  {:<{}}", label, first_column - 2);
    for (const CLI::Option* option : options) {
      const std::string name = "--" + option->get_lnames().front();
      if (line.size() + 1 + name.size() > line_width) {
        text += line + "\n";
        line = std::string(first_column, ' ');
      }
      if (line.back() != ' ') line += ' ';
      line += name;
    }
    return text + line + "\n";
  }
};

/// The letters to insert, drop, replace or swap with a neighbour that make one word another
/// (optimal string alignment).
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool differ = a[i - 1] != b[j - 1];
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + differ});
      if (i > 1 && j > 1 && differ && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
    names.insert(names.end(), command->get_aliases().begin(), command->get_aliases().end());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// "unknown option: --keap; did you mean --keep?", or which commands have it.
std::string unknown_option(const std::string& word, const CLI::App& command) {
  const std::string name = word.substr(0, word.find('='));
  const std::string text = "unknown option: " + name;
  const std::string near = nearest_word(name, option_names(command));
  if (!near.empty()) return fmt::format("{}; did you mean {}?", text, near);
  std::vector<std::string> others;
  for (const CLI::App* other : command.get_parent()->get_subcommands({}))
    if (other->get_option_no_throw(name) != nullptr) others.push_back(other->get_name());
  return others.empty() ? text : fmt::format("{}, an option of {}", text, fmt::join(others, ", "));
}

std::string unknown_words(const CLI::App& command, const std::string& otherwise) {
  std::vector<std::string> extra = command.remaining(true);
  // Those without a dash come in reverse order.
  const auto unknown = std::ranges::find_if(
      extra, [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  if (unknown != extra.end()) return unknown_option(*unknown, command);
  if (extra.empty()) return otherwise;
  std::string text = "unexpected argument: " + extra.back();
  double number = 0;
  if (!CLI::detail::lexical_cast(extra.back(), number))
    return command.get_option_no_throw("--output") != nullptr ? text + "; -o names the output"
                                                              : text;
  return text + "; an optional value follows its option after '=', as in --option=" + extra.back();
}

std::string no_number(const std::string& text, const CLI::App& command) {
  const std::size_t equals = text.find(" = ");
  const std::size_t begin = text.find(": ");
  if (equals == std::string::npos || begin == std::string::npos) return text;
  const std::string option = text.substr(begin + 2, equals - begin - 2);
  const CLI::Option* found = command.get_option_no_throw(option);
  const bool whole = found != nullptr && found->get_type_name().find("INT") != std::string::npos;
  return fmt::format("{}: '{}' is not a {}", option, text.substr(equals + 3),
                     whole ? "whole number in range" : "number");
}

std::string explain_in(const CLI::ParseError& error, const CLI::App& command) {
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return unknown_words(command, text);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr &&
      text.find(" required ") != std::string::npos) {
    const std::string option = text.substr(0, text.find(':'));
    if (text.find("At Most") != std::string::npos) return option + " is given more than once";
    return option +
           (text.find(" 2 required") != std::string::npos ? " needs two values" : " needs a value");
  }
  if (const auto end = text.find(" was given a disallowed flag override"); end != std::string::npos)
    return "--" + text.substr(0, end) + " takes no value";
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return no_number(text, command);
  return text;
}

std::string unknown_command(const std::string& word, const CLI::App& program) {
  const std::string near = nearest_word(word, command_names(program));
  return "unknown command: " + word + (near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

}  // namespace

void describe_program(CLI::App& program) {
  program.name("medial");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_version_flag("--version", "medial " MEDIAL_VERSION, "Print the version.");
  program.set_help_flag("--help,-h", "Print this help.");
  program.set_help_all_flag("--help-all", "Print this help with all options of all commands.");
  program.option_defaults()->disable_flag_override();
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.footer(
      "Run `medial COMMAND --help` for its options and examples.\n"
      "\n"
      "Exit status: 0 for success; 1 if `verify`, `legal` or `compare` rejects an axis, or\n"
      "`doctor` finds a fault; 2 for an error, printed as one line on standard error: `medial:\n"
      "FILE: feature F, ring R, vertex V at (X, Y): TEXT [CODE]`, with the place where edges\n"
      "cross instead of the vertex's if they do. Features, rings and vertices count from 0.\n"
      "After an error or an interruption there is no output, not even a partial file.");
}

void heed_help_anywhere(CLI::App& program) {
  const auto end_by = [](CLI::App& app, const char* name, auto call) {
    app.get_option(name)
        ->group(std::string(common_group))
        ->trigger_on_parse()
        ->each([call](const std::string&) { throw call; });
  };
  for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; })) {
    end_by(*command, "--help", CLI::CallForHelp());
    end_by(*command, "--help-all", CLI::CallForAllHelp());
  }
}

CLI::App* find_command(CLI::App& program, const std::string& name) {
  const auto found =
      program.get_subcommands([&name](CLI::App* command) { return command->check_name(name); });
  return found.empty() ? nullptr : found.front();
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 4) + 1;
  for (const std::string& candidate : known) {
    // Most typing errors are at the end: an unfinished word stands for the first that begins with
    // it.
    const bool unfinished = word.size() > 3 && candidate.starts_with(word);
    const std::size_t apart = unfinished ? 1 : letters_apart(word, candidate);
    if (apart < fewest) {
      fewest = apart;
      nearest = candidate;
    }
  }
  return nearest;
}

Complaint explain(const CLI::ParseError& error, const CLI::App& program) {
  const std::vector<const CLI::App*> chosen =
      program.get_subcommands([](const CLI::App* command) { return command->parsed() > 0; });
  if (!chosen.empty())
    return {explain_in(error, *chosen.back()),
            fmt::format("; see medial {} --help", chosen.back()->get_name())};
  const std::vector<std::string> unknown = program.remaining();
  return {unknown.empty() ? "a command is missing" : unknown_command(unknown[0], program),
          "; see medial --help"};
}

Command make_help_command(CLI::App& program) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("help", "Print the help of a command.");
  command->add_option("COMMAND", *name, "Its name.")->option_text(" ");
  return {command, [&program, name]() -> Result<int> {
            const CLI::App* wanted = name->empty() ? &program : find_command(program, *name);
            if (wanted == nullptr) return invalid_option(unknown_command(*name, program));
            program.clear();  // or else it would print the help of `help`
            Status printed = print(wanted->help(wanted == &program ? "" : "medial"));
            if (!printed) return std::move(printed).error();
            return exit_success;
          }};
}

}  // namespace medial::cli

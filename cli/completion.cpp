// medial completion: makes completion scripts for shells from the commands' options.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/help.h"

namespace medial::cli {
namespace {

/// The properties of an option that completion scripts use.
struct Flag {
  std::vector<std::string> names;    ///< with their dashes
  std::string help;                  ///< a few words
  std::vector<std::string> choices;  ///< of the value
  bool has_value = false;
};

struct Completions {
  std::string command, help;
  std::vector<Flag> flags;
};

/// The first clause of a text, without characters that are special in shells.
std::string summary_of(const std::string& text) {
  std::string summary = text.substr(0, text.find_first_of(".(;:["));
  for (char& c : summary)
    if (c == '\n' || c == '\'' || c == '`' || c == ']') c = ' ';
  return CLI::detail::trim_copy(summary);
}

/// The names in the braces of a type such as "TEXT:{auto,disks}".
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

Completions completions_of(const CLI::App& command) {
  Completions all{command.get_name(), summary_of(command.get_description()), {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) continue;
    Flag flag{{},
              summary_of(option->get_description()),
              choices_of(*option),
              option->get_items_expected_max() > 0};
    for (const std::string& name : option->get_lnames()) flag.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) flag.names.push_back("-" + name);
    all.flags.push_back(std::move(flag));
  }
  return all;
}

std::string bash_script(const std::vector<Completions>& commands) {
  std::string names, options, choices;
  for (const Completions& one : commands) {
    names += one.command + " ";
    std::string words;
    for (const Flag& flag : one.flags) {
      words += fmt::format("{} ", fmt::join(flag.names, " "));
      if (!flag.choices.empty())
        choices += fmt::format("    {}:{}) words='{}' ;;\n", one.command, flag.names.front(),
                               fmt::join(flag.choices, " "));
    }
    options += fmt::format("      {}) words='{}' ;;\n", one.command, words);
  }
  return fmt::format(
      R"(_medial() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=
  if (( COMP_CWORD == 1 )); then
    words='{}'
  elif [[ $word == -* ]]; then
    case ${{COMP_WORDS[1]}} in
{}    esac
  else case ${{COMP_WORDS[1]}}:${{COMP_WORDS[COMP_CWORD-1]}} in
    help:help) words='{}' ;;
{}    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _medial medial
)",
      names, options, names, choices);
}

std::string zsh_script(const std::vector<Completions>& commands) {
  std::string names, options;
  for (const Completions& one : commands) {
    names += fmt::format("    '{}:{}'\n", one.command, one.help);
    options += fmt::format("    {}) _arguments", one.command);
    for (const Flag& flag : one.flags)
      for (const std::string& name : flag.names)
        options += fmt::format(" \\\n      '{}[{}]{}'", name, flag.help,
                               !flag.choices.empty()
                                   ? fmt::format(":value:({})", fmt::join(flag.choices, " "))
                               : flag.has_value ? ":value:_files"
                                                : "");
    options += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(
      R"(#compdef medial
_medial() {{
  local -a commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
    help) _describe command commands ;;
{}  esac
}}
compdef _medial medial
)",
      names, options);
}

std::string fish_script(const std::vector<Completions>& commands) {
  std::string text, names;
  for (const Completions& one : commands) {
    names += one.command + " ";
    text += fmt::format("complete -c medial -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        one.command, one.help);
    for (const Flag& flag : one.flags) {
      text += fmt::format("complete -c medial -n '__fish_seen_subcommand_from {}'", one.command);
      for (const std::string& name : flag.names)
        text +=
            fmt::format(" -{} {}", name[1] == '-' ? "l" : "s", name.substr(name[1] == '-' ? 2 : 1));
      if (!flag.choices.empty())
        text += fmt::format(" -x -a '{}'", fmt::join(flag.choices, " "));
      else if (flag.has_value)
        text += " -r";
      text += fmt::format(" -d '{}'\n", flag.help);
    }
  }
  return text + fmt::format("complete -c medial -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
                            names);
}

using Script = std::string (*)(const std::vector<Completions>& commands);

}  // namespace

Command make_completion_command(CLI::App& program) {
  auto script = std::make_shared<Script>();
  CLI::App* command = program.add_subcommand(
      "completion", "Print a script that completes command lines: for bash, zsh or fish.");
  add_choice<Script>(*command, "SHELL", *script,
                     {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}},
                     "bash, zsh or fish.")
      ->required()
      ->option_text(" ");
  command->footer(
      "An installed medial has these scripts where the shells look for them.\n"
      "\n"
      "Examples:\n"
      "  source <(medial completion bash)\n"
      "  medial completion fish > ~/.config/fish/completions/medial.fish");
  return {command, [&program, script]() -> Result<int> {
            std::vector<Completions> all;
            for (const CLI::App* one : program.get_subcommands({}))
              all.push_back(completions_of(*one));
            Status printed = print((*script)(all));
            if (!printed) return std::move(printed).error();
            return exit_success;
          }};
}

}  // namespace medial::cli

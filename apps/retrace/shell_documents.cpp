#include "shell_documents.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <place/version.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& root) {
  return root.get_subcommands([](const CLI::App* app) { return !app->get_name().empty(); });
}

/// A command's options, including those in groups.
std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  std::vector<const CLI::Option*> options = app.get_options();
  for (const CLI::App* group :
       app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); })) {
    for (const CLI::Option* option : group->get_options()) options.push_back(option);
  }
  return options;
}

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  return flags;
}

/// The names between the braces of a choice's type: {a,b,c}.
std::vector<std::string> values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

/// Roff reads a line that begins with a dot or a quote as a request, and a backslash as an escape.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

/// Zsh ends a description at a bracket, and a specification at a colon or a quote.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c == '\'' ? ' ' : c;
  }
  return out;
}

}  // namespace

std::string bash_completion(const CLI::App& root) {
  std::vector<std::string> names;
  std::string cases, values;
  for (const CLI::App* command : commands_of(root)) {
    names.push_back(command->get_name());
    std::vector<std::string> flags;
    for (const CLI::Option* option : options_of(*command)) {
      const auto of_option = flags_of(*option);
      flags.insert(flags.end(), of_option.begin(), of_option.end());
      const auto choices = values_of(*option);
      if (!choices.empty())  // of a positional one, right behind the command
        values +=
            fmt::format("    '{} {}') words='{}' ;;\n", command->get_name(),
                        of_option.empty() ? command->get_name() : of_option.back(), fmt::join(choices, " "));
    }
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), fmt::join(flags, " "));
  }
  return fmt::format(R"(# Completions of retrace for bash, written by `retrace completion bash`.
_retrace() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" command="${{COMP_WORDS[1]}}" words=''
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$current"))
    return
  fi
  case "$command $before" in
{}  esac
  if [[ -z $words && $current == -* ]]; then
    case "$command" in
{}    esac
  fi
  if [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _retrace retrace
)",
                     fmt::join(names, " "), values, cases);
}

std::string zsh_completion(const CLI::App& root) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(root)) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    cases += fmt::format("      {}) _arguments", command->get_name());
    for (const CLI::Option* option : options_of(*command)) {
      const auto flags = flags_of(*option);
      const auto choices = values_of(*option);
      const bool takes_value = option->get_items_expected_max() > 0;
      for (const std::string& flag : flags) {
        cases += fmt::format(" \\\n        '{}[{}]{}'", flag, zsh_text(option->get_description()),
                             !takes_value      ? ""
                             : choices.empty() ? ":value:_files"
                                               : fmt::format(":value:({})", fmt::join(choices, " ")));
      }
    }
    std::string positional = "_files";
    for (const CLI::Option* option : options_of(*command))
      if (const auto choices = values_of(*option); flags_of(*option).empty() && !choices.empty())
        positional = fmt::format("({})", fmt::join(choices, " "));
    cases += fmt::format(" \\\n        '*:file:{}' ;;\n", positional);
  }
  return fmt::format(R"(#compdef retrace
# Completions of retrace for zsh, written by `retrace completion zsh`.
_retrace() {{
  local -a commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
  else
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
  fi
}}
_retrace "$@"
)",
                     commands, cases);
}

std::string manual_page(const CLI::App& root, const std::string& command) {
  const auto commands = commands_of(root);
  if (command.empty()) {
    std::string page = fmt::format(
        ".TH RETRACE 1 \"\" \"retrace {}\"\n.SH NAME\nretrace \\- {}\n.SH SYNOPSIS\n.B retrace\n.I command\n"
        "[options]\n.SH COMMANDS\n",
        place::kVersion, roff("where you are on a route you have walked before, from video alone"));
    for (const CLI::App* sub : commands)
      page += fmt::format(".TP\n.B {}\n{}\n", roff(sub->get_name()), roff(sub->get_description()));
    return page + ".SH EXIT STATUS\n0 done, 1 failed (one line says why), 2 wrong usage.\n";
  }
  const auto found = std::ranges::find(commands, command, &CLI::App::get_name);
  if (found == commands.end()) throw vo::Error(command, "is no command", "one that `retrace --help` lists");
  const CLI::App& app = **found;
  std::string name = command;
  std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(
      ".TH RETRACE\\-{} 1 \"\" \"retrace {}\"\n.SH NAME\nretrace\\-{} \\- {}\n.SH SYNOPSIS\n.B retrace {}\n",
      roff(name), place::kVersion, roff(command), roff(app.get_description()), roff(command));
  std::string positional, flags;
  for (const CLI::Option* option : options_of(app)) {
    const auto names = flags_of(*option);
    if (names.empty()) {
      page += fmt::format(".I {}\n", roff(option->get_name()));
      positional +=
          fmt::format(".TP\n.I {}\n{}\n", roff(option->get_name()), roff(option->get_description()));
      continue;
    }
    const std::string standard = option->get_default_str();
    flags += fmt::format(".TP\n.B {}", roff(fmt::format("{}", fmt::join(names, ", "))));
    if (option->get_items_expected_max() > 0)
      flags += fmt::format(" \\fI{}\\fR", roff(option->get_type_name()));
    flags += fmt::format("\n{}{}\n", roff(option->get_description()),
                         standard.empty() ? "" : roff(fmt::format(" [{}]", standard)));
  }
  page += "[options]\n";
  if (!positional.empty()) page += ".SH ARGUMENTS\n" + positional;
  page += ".SH OPTIONS\n" + flags;
  if (!app.get_footer().empty()) page += ".SH NOTES\n.nf\n" + roff(app.get_footer()) + "\n.fi\n";
  return page;
}

}  // namespace retrace

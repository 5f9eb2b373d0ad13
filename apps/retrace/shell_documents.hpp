#pragma once

#include <string>

namespace CLI {
class App;
}

/// Generated from the declared commands and settings, so that they are never out of date.
namespace retrace {

/// A script for bash: commands, the flags of each, the values of choices, and files.
std::string bash_completion(const CLI::App& root);

/// The same for zsh, with descriptions.
std::string zsh_completion(const CLI::App& root);

/// A page of the manual in roff: of a command or, for an empty name, of the program. Throws `vo::Error` for
/// an unknown command.
std::string manual_page(const CLI::App& root, const std::string& command);

}  // namespace retrace

#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <place/settings.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace retrace {

/// Arguments that do not go together, where the parser cannot know; the exit status is that of bad usage.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Options that most commands share.
struct CommonOptions {
  bool force = false;
  bool json = false;
};

/// One argument of a command, to refine it.
class Argument {
 public:
  explicit Argument(CLI::Option* option) : option_(option) {}

  Argument& required();
  Argument& optional();      ///< of a positional one, which is required otherwise
  Argument& positive();      ///< a number above 0
  Argument& non_negative();  ///< a number of at least 0
  Argument& range(double least, double most);
  Argument& existing_file();
  Argument& comma_separated();           ///< of a list
  Argument& count(int least, int most);  ///< of a list
  Argument& group(const std::string& name);
  Argument& excludes(const Argument& other);
  Argument& needs(const Argument& other);

 private:
  friend class Arguments;
  CLI::Option* option_;
};

/// The arguments of one command: everything declared here is parsed, checked and explained by --help. CLI11
/// does the work.
///
/// Targets must live as long as the command; their initial values are the defaults. Types: std::string, int,
/// std::size_t, std::uint64_t, double, std::optional of these, and std::vector of std::string or std::size_t.
class Arguments {
 public:
  /// `all`: --help shows every setting, not only those that most people use.
  Arguments(CLI::App& app, bool all);

  template <typename T>
  Argument positional(const std::string& name, T& target, const std::string& description);
  template <typename T>
  Argument option(const std::string& flag, T& target, const std::string& description);
  Argument flag(const std::string& name, bool& target, const std::string& description);
  /// For few users: only --help-all shows it.
  void rare(const Argument& argument);

  /// An option whose value is one of a few names.
  template <typename Choice>
  Argument choice(const std::string& flag, Choice& target,
                  const std::vector<std::pair<std::string, Choice>>& choices,
                  const std::string& description) {
    std::vector<std::string> names;
    std::string current;
    for (const auto& [text, value] : choices) {
      names.push_back(text);
      if (value == target) current = text;
    }
    return named_choice(
        flag, names, current,
        [&target, choices](const std::string& text) {
          target = std::ranges::find(choices, text, &std::pair<std::string, Choice>::first)->second;
        },
        description);
  }

  /// Exactly one of these must be given.
  void exactly_one(std::initializer_list<Argument> arguments);

  /// The settings of these groups as flags, and --config, a file of settings that flags override. `target`
  /// holds the given settings after parsing.
  void settings(place::Settings& target, std::initializer_list<place::SettingGroup> groups,
                const std::vector<std::string>& without = {});
  /// --force and --json.
  void common(CommonOptions& target);
  void force(CommonOptions& target);
  void json(CommonOptions& target);

  /// Lines below the help: examples.
  void footer(const std::string& text);

  /// Adds the settings of --config below the flags. Called after parsing. Throws `vo::Error` for a file that
  /// cannot be read as settings.
  void finish();

 private:
  Argument named_choice(const std::string& flag, const std::vector<std::string>& names,
                        const std::string& current, std::function<void(const std::string&)> take,
                        const std::string& description);
  void setting(place::Settings& target, const place::Setting& setting);

  CLI::App& app_;
  bool all_;
  std::string config_;
  place::Settings* settings_ = nullptr;
};

}  // namespace retrace

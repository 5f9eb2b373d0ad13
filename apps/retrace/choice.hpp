#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace retrace {

template <typename Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

/// An option whose value is one of a few names.
template <typename Choice>
CLI::Option* add_choice(CLI::App& app, const std::string& group, const std::string& name, Choice& target,
                        const Choices<Choice>& choices, const std::string& description) {
  std::vector<std::string> names;
  std::string current;
  for (const auto& [text, value] : choices) {
    names.push_back(text);
    if (value == target) current = text;
  }
  return app
      .add_option_function<std::string>(
          name,
          [&target, choices](const std::string& text) {
            target = std::ranges::find(choices, text, &Choices<Choice>::value_type::first)->second;
          },
          description)
      ->default_str(current)
      ->check(CLI::IsMember(names))
      ->group(group)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

}  // namespace retrace

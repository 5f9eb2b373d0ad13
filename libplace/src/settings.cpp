#include "place/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/text_file.hpp>

namespace place {
namespace {

/// Calls `visit` with each part of a text between separators.
template <typename Visit>
void for_each_part(std::string_view text, char separator, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

bool is_one_of(std::string_view value, std::string_view choices) {
  bool found = false;
  for_each_part(choices, '|', [&](std::string_view choice) { found = found || choice == value; });
  return found;
}

std::string with_commas(std::string_view choices) {
  std::string text;
  for_each_part(choices, '|', [&](std::string_view choice) {
    text += text.empty() ? "" : ", ";
    text += choice;
  });
  return text;
}

std::string range_of(const Setting& setting) {
  if (!std::isfinite(setting.most))
    return fmt::format("a number {} {}", setting.above_least ? "above" : "of at least", setting.least);
  return fmt::format("{} to {}", setting.least, setting.most);
}

[[noreturn]] void refuse(const Setting& setting, std::string_view value, const std::string& expected) {
  throw vo::Error(std::string(setting.name), fmt::format("is '{}'", value), expected);
}

template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

void check_number(const Setting& setting, double value) {
  const bool low = setting.above_least ? !(value > setting.least) : !(value >= setting.least);
  if (low || !(value <= setting.most) || !std::isfinite(value))
    refuse(setting, fmt::format("{:g}", value), range_of(setting));
}

void check_text(const Setting& setting, const std::string& value) {
  if (value.empty()) refuse(setting, value, "a value");
  // What no line of a settings file could hold, and no name of a file that people type.
  if (std::ranges::any_of(value, [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
    refuse(setting, vo::printable(value), "text without control characters");
  if (!setting.choices.empty() && !is_one_of(value, setting.choices))
    refuse(setting, value, "one of " + with_commas(setting.choices));
}

template <typename Value>
void check(const Setting& setting, const Value& value) {
  if constexpr (std::is_same_v<Value, std::string>) {
    check_text(setting, value);
  } else if constexpr (!std::is_same_v<Value, bool>) {
    check_number(setting, value);
  }
}

std::string as_text(const std::string& value) {
  return value;
}
std::string as_text(bool value) {
  return value ? "true" : "false";
}
std::string as_text(int value) {
  return fmt::format("{}", value);
}
std::string as_text(double value) {
  return fmt::format("{}", value);
}

bool parse(const Setting& setting, std::string_view text, bool*) {
  if (text == "true") return true;
  if (text != "false") refuse(setting, text, "true or false");
  return false;
}
int parse(const Setting& setting, std::string_view text, int*) {
  const std::optional<int> value = number<int>(text);
  if (!value) refuse(setting, text, "a whole number");
  return *value;
}
double parse(const Setting& setting, std::string_view text, double*) {
  const std::optional<double> value = number<double>(text);
  if (!value) refuse(setting, text, "a number");
  return *value;
}
std::string parse(const Setting&, std::string_view text, std::string*) {
  return std::string(text);
}

/// Levenshtein's distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string_view name_of(SettingGroup group) {
  switch (group) {
    case SettingGroup::kReading:
      return "Reading";
    case SettingGroup::kDescribing:
      return "Describing";
    case SettingGroup::kMotion:
      return "Motion and sampling";
    case SettingGroup::kOdometry:
      return "Pedestrian odometry";
    case SettingGroup::kSearch:
      return "Search";
    case SettingGroup::kGeneral:
      break;
  }
  return "General";
}

const Setting& setting_named(std::string_view name) {
  const auto table = settings_table();
  const auto found = std::ranges::find(table, name, &Setting::name);
  if (found != table.end()) return *found;
  std::vector<std::string> names;
  for (const Setting& setting : table) names.emplace_back(setting.name);
  const std::string nearest = nearest_name(name, names);
  throw vo::Error(std::string(name), "is no setting",
                  nearest.empty() ? "a name of configs/default.toml" : nearest + "?");
}

std::optional<std::string> text_of(const Settings& settings, const Setting& setting) {
  return std::visit(
      [&](auto field) {
        const auto& value = settings.*field;
        return value ? std::optional(as_text(*value)) : std::nullopt;
      },
      setting.field);
}

void set(Settings& settings, const Setting& setting, std::string_view text) {
  std::visit(
      [&](auto field) {
        using Value = typename std::remove_cvref_t<decltype(settings.*field)>::value_type;
        const Value value = parse(setting, text, static_cast<Value*>(nullptr));
        check(setting, value);
        settings.*field = value;
      },
      setting.field);
}

void reset(Settings& settings, const Setting& setting) {
  std::visit([&](auto field) { (settings.*field).reset(); }, setting.field);
}

void check_ranges(const Settings& settings) {
  for (const Setting& setting : settings_table()) {
    std::visit(
        [&](auto field) {
          if (settings.*field) check(setting, *(settings.*field));
        },
        setting.field);
  }
}

Settings merged(const Settings& given, const Settings& otherwise) {
  Settings both = given;
  for (const Setting& setting : settings_table()) {
    std::visit(
        [&](auto field) {
          if (!(both.*field)) both.*field = otherwise.*field;
        },
        setting.field);
  }
  return both;
}

bool has_effect(const Settings& settings, const Setting& setting, std::string* why_not) {
  bool holds = true;
  for_each_part(setting.when, '&', [&](std::string_view condition) {
    if (!holds) return;
    const bool absent = condition.starts_with('!');
    const std::size_t equals = absent ? condition.size() : condition.find('=');
    const bool differs = !absent && condition[equals - 1] == '!';
    const std::string_view name = absent    ? condition.substr(1)
                                  : differs ? condition.substr(0, equals - 1)
                                            : condition.substr(0, equals);
    const std::optional<std::string> value = text_of(settings, setting_named(name));
    bool among = false;
    if (!absent && value) {
      for_each_part(*value, '+', [&](std::string_view part) {
        among = among || is_one_of(part, condition.substr(equals + 1));
      });
    }
    holds = absent ? !value : among != differs;
    if (holds || why_not == nullptr) return;
    *why_not = absent  ? fmt::format("{} is given", name)
               : value ? fmt::format("{} is {}", name, *value)
                       : fmt::format("{} has no value", name);
  });
  return holds;
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t fewest = name.size() / 2 + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(name.size(), candidate.size());
    if (longer - std::min(name.size(), candidate.size()) >= fewest) continue;  // it takes so many at least
    if (const std::size_t count = edits(name, candidate); count < fewest) {
      fewest = count;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace place

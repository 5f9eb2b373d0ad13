#include "json_file.hpp"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

namespace retrace {

using nlohmann::ordered_json;

ordered_json read_json_object(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) return ordered_json::object();
  constexpr int kDeepest = 8;
  const auto shallow = [](int depth, ordered_json::parse_event_t, ordered_json&) {
    return depth <= kDeepest;
  };
  ordered_json json = ordered_json::parse(file, shallow, false);
  return json.is_object() ? json : ordered_json::object();
}

std::string json_text(const ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

const ordered_json& member(const ordered_json& json, const char* name) {
  static const ordered_json none;
  if (!json.is_object()) return none;
  const auto found = json.find(name);
  return found == json.end() ? none : *found;
}

std::optional<double> number_in(const ordered_json& json, const char* name) {
  const ordered_json& value = member(json, name);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::optional<std::string> text_in(const ordered_json& json, const char* name) {
  const ordered_json& value = member(json, name);
  return value.is_string() ? std::optional(value.get<std::string>()) : std::nullopt;
}

std::optional<std::int64_t> count_in(const ordered_json& json, const char* name) {
  constexpr double kExact = 9007199254740992;  // 2^53
  const std::optional<double> value = number_in(json, name);
  if (!value || !(*value >= 0 && *value <= kExact) || *value != std::floor(*value)) return {};
  return static_cast<std::int64_t>(*value);
}

std::vector<double> numbers_in(const ordered_json& json, const char* name) {
  std::vector<double> values;
  const ordered_json& array = member(json, name);
  if (!array.is_array()) return values;
  values.reserve(array.size());
  for (const ordered_json& value : array) values.push_back(value.is_number() ? value.get<double>() : NAN);
  return values;
}

std::vector<std::string> texts_in(const ordered_json& json, const char* name) {
  std::vector<std::string> texts;
  const ordered_json& array = member(json, name);
  if (!array.is_array()) return texts;
  for (const ordered_json& value : array)
    if (value.is_string()) texts.push_back(value.get<std::string>());
  return texts;
}

}  // namespace retrace

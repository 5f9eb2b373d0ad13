#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// JSON to and from files: what is read may have been written by anyone.
namespace retrace {

/// Reads an object from a file; an empty one if the file is missing, or holds no JSON or no object. What lies
/// deeper in it than eight objects and arrays is left out.
nlohmann::ordered_json read_json_object(const std::filesystem::path& path);

/// The text of JSON, in lines with `indent` >= 0. Bytes of a text that are no UTF-8, such as a file's name
/// may have, are replaced by U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// A member of an object; null if it has none of that name or is no object.
const nlohmann::ordered_json& member(const nlohmann::ordered_json& json, const char* name);

/// A member of that kind, otherwise none.
std::optional<double> number_in(const nlohmann::ordered_json& json, const char* name);
std::optional<std::string> text_in(const nlohmann::ordered_json& json, const char* name);
/// A whole number from 0 to 2^53.
std::optional<std::int64_t> count_in(const nlohmann::ordered_json& json, const char* name);
/// The elements of an array; NaN for those that are no number. Empty if the member is no array.
std::vector<double> numbers_in(const nlohmann::ordered_json& json, const char* name);
/// The texts of an array; others are left out.
std::vector<std::string> texts_in(const nlohmann::ordered_json& json, const char* name);

}  // namespace retrace

#include "io/flat_yaml.hpp"

#include "vo/io/csv.hpp"

#include <algorithm>
#include <string_view>

namespace vo {
namespace {

/// A line without its comment.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0) {
      if (line[i] == quote) quote = 0;
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    } else if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      return line.substr(0, i);
    }
  }
  return line;
}

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0])
    return text.substr(1, text.size() - 2);
  return text;
}

/// A value without the tag before it (`!!opencv-matrix`).
std::string_view untagged(std::string_view value) {
  value = trimmed(value);
  if (!value.starts_with('!')) return value;
  const std::size_t end = value.find_first_of(" \t");
  return end == std::string_view::npos ? std::string_view() : trimmed(value.substr(end));
}

std::ptrdiff_t open_brackets(std::string_view text) {
  return std::ranges::count(text, '[') - std::ranges::count(text, ']');
}

/// Where the value of a `key: value` line begins; npos if it is none.
std::size_t colon_of(std::string_view line) {
  for (std::size_t i = line.find(':'); i != std::string_view::npos; i = line.find(':', i + 1)) {
    if (i + 1 == line.size() || line[i + 1] == ' ' || line[i + 1] == '\t') return i;
  }
  return std::string_view::npos;
}

/// A key that lines further in belong to.
struct Level {
  std::size_t indent;
  std::string path;
};

}  // namespace

FlatYaml read_flat_yaml(const std::vector<TextLine>& lines) {
  // Settings have short names and are few; without a limit, the paths of keys in a long key would take memory
  // by the square of the file.
  constexpr std::size_t kLongestPath = 64, kMostKeys = 1000;
  FlatYaml yaml;
  std::vector<Level> levels;
  std::string* open = nullptr;  // a list with brackets that are not closed yet
  std::ptrdiff_t brackets = 0;  // that many
  for (const TextLine& text : lines) {
    const std::string_view line = without_comment(text.text), content = trimmed(line);
    if (content.empty() || content.starts_with('%') || content == "---" || content == "...") continue;
    if (open != nullptr) {
      open->append(" ").append(content);
      brackets += open_brackets(content);
      if (brackets <= 0) open = nullptr;
      continue;
    }
    const std::size_t indent = line.find_first_not_of(" \t");
    if (content.starts_with("- ")) {
      // Of the key before it, which may be as far in.
      while (!levels.empty() && levels.back().indent > indent) levels.pop_back();
      if (levels.empty() || levels.back().path.size() > kLongestPath) continue;
      std::string& list = yaml[levels.back().path];
      list.append(list.empty() ? "" : ", ").append(trimmed(content.substr(1)));
      brackets = open_brackets(content);
      if (brackets > 0) open = &list;
      continue;
    }
    const std::size_t colon = colon_of(content);
    if (colon == std::string_view::npos) continue;
    while (!levels.empty() && levels.back().indent >= indent) levels.pop_back();
    std::string path = levels.empty() ? std::string() : levels.back().path + '.';
    path += unquoted(content.substr(0, colon));
    if (path.size() > kLongestPath || yaml.size() >= kMostKeys) {
      levels.push_back({indent, std::string(kLongestPath + 1, ' ')});  // what it holds is skipped too
      continue;
    }
    std::string& value = yaml[path];
    value = unquoted(untagged(content.substr(colon + 1)));
    brackets = open_brackets(value);
    if (brackets > 0) open = &value;
    levels.push_back({indent, std::move(path)});
  }
  return yaml;
}

std::optional<std::vector<double>> numbers_of(const std::string& value) {
  std::vector<double> numbers;
  constexpr std::string_view kBetween = "[], \t";
  for (std::size_t begin = value.find_first_not_of(kBetween); begin != std::string::npos;
       begin = value.find_first_not_of(kBetween, begin)) {
    const std::size_t end = std::min(value.find_first_of(kBetween, begin), value.size());
    std::string_view cell = std::string_view(value).substr(begin, end - begin);
    if (cell.ends_with('.') && cell.size() > 1) cell.remove_suffix(1);  // OpenCV writes 0. and 319.
    const std::optional<double> number = parse_number(cell);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    begin = end;
  }
  return numbers;
}

}  // namespace vo

#include "chart.hpp"

#include "json_file.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {

using nlohmann::ordered_json;

ordered_json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == std::floor(value) && std::abs(value) < 1e9) return static_cast<std::int64_t>(value);
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{:.6g}", value);
  text.push_back('\0');
  return std::strtod(text.data(), nullptr);
}

ordered_json rounded(const std::vector<double>& values) {
  ordered_json json = ordered_json::array();
  for (const double value : values) json.push_back(rounded(value));
  return json;
}

Series styled(Series series, std::size_t index) {
  static const std::vector<std::string> kColours{"blue", "orange", "green", "purple", "ochre", "grey"};
  static const std::vector<std::string> kMarks{"circle", "triangle", "square", "diamond", "cross", "star"};
  static const std::vector<std::vector<int>> kDashes{{}, {8, 3}, {2, 3}, {10, 3, 2, 3}};
  series.colour = kColours[index % kColours.size()];
  series.mark = kMarks[index % kMarks.size()];
  series.dash = kDashes[index % kDashes.size()];
  return series;
}

namespace {

ordered_json series_json(const Series& series) {
  ordered_json json{
      {"name", series.name},     {"x", rounded(series.x)},      {"y", rounded(series.y)},
      {"colour", series.colour}, {"line", series.line},         {"mark", series.mark},
      {"hollow", series.hollow}, {"width", series.width_px},    {"dash", series.dash},
      {"size", series.size_px},  {"bar_ends", series.bar_ends}, {"label_at_end", series.label_at_end}};
  if (!series.notes.empty()) json["notes"] = series.notes;
  return json;
}

}  // namespace

std::string to_json(const Chart& chart) {
  ordered_json json{{"title", chart.title},          {"x_title", chart.x_title},
                    {"y_title", chart.y_title},      {"equal", chart.equal},
                    {"zoomable", chart.zoomable},    {"series", ordered_json::array()},
                    {"bands", ordered_json::array()}};
  for (const Series& series : chart.series) json["series"].push_back(series_json(series));
  for (const Band& band : chart.bands) {
    ordered_json spans = ordered_json::array();
    for (const auto& [from, to] : band.spans) spans.push_back({rounded(from), rounded(to)});
    json["bands"].push_back({{"name", band.name}, {"colour", band.colour}, {"spans", std::move(spans)}});
  }
  if (!chart.y_names.empty()) json["y_names"] = chart.y_names;
  if (chart.x_range) json["x_range"] = *chart.x_range;
  if (chart.y_range) json["y_range"] = *chart.y_range;
  if (const auto& b = chart.backdrop) {
    json["picture"] = {{"source", b->source},
                       {"left", b->left},
                       {"right", b->right},
                       {"top", b->top},
                       {"bottom", b->bottom}};
  }
  return json_text(json);
}

}  // namespace retrace

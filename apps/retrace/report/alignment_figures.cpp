#include "alignment_figures.hpp"

#include "json_file.hpp"

#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

std::vector<std::pair<double, double>> spans_in(const ordered_json& json, const char* name) {
  std::vector<std::pair<double, double>> spans;
  const ordered_json& array = member(json, name);
  if (!array.is_array()) return spans;
  for (const ordered_json& span : array) {
    if (span.is_array() && span.size() == 2 && span[0].is_number() && span[1].is_number())
      spans.emplace_back(span[0].get<double>(), span[1].get<double>());
  }
  return spans;
}

/// A picture that is part of the page; none from elsewhere.
std::optional<std::string> picture_in(const ordered_json& json, const char* name) {
  std::optional<std::string> url = text_in(json, name);
  return url && url->starts_with("data:image/") ? url : std::nullopt;
}

void put_pictures(Page& page, const ordered_json& data) {
  const ordered_json& pictures = member(data, "pictures");
  if (!pictures.is_array() || pictures.empty()) return;
  page.heading("What stays and what passes by");
  page.begin_row();
  for (const ordered_json& picture : pictures) {
    const auto url = picture_in(picture, "picture");
    const auto seconds = number_in(picture, "seconds"), mean = number_in(picture, "mean");
    if (!url || !seconds || !mean) continue;
    page.picture(*url, fmt::format("mean absolute difference of each pixel, {:.2f} s apart", *seconds),
                 fmt::format("{:.2f} s apart: {:.1f} grey levels in the mean", *seconds, *mean));
  }
  page.end_row();
  page.paragraph(
      fmt::format("The absolute difference of two pictures, averaged over the walk: dark where the view "
                  "stays, as in the sky and on the pavement, bright where it changes, up to {:.1f} grey "
                  "levels [SSS Fig. 1a].",
                  number_in(pictures[0], "most").value_or(0)));
}

Chart heat_chart(std::string heat, double end_s, double step_s, std::size_t spans) {
  const double top_s = (static_cast<double>(spans) + 0.5) * step_s;
  return {.title = "alignment error over frames and separations",
          .x_title = "time, s",
          .y_title = "separation, s",
          .x_range = std::array{0.0, end_s},
          .y_range = std::array{0.5 * step_s, top_s},
          .backdrop =
              Backdrop{
                  .source = std::move(heat), .left = 0, .right = end_s, .top = top_s, .bottom = 0.5 * step_s},
          .zoomable = true,
          .size = "wide"};
}

Chart course_chart(const ordered_json& data, const std::vector<vo::WalkedTurn>& turns, double end_s) {
  const ordered_json& course = member(data, "course");
  const std::vector<double> time_s = numbers_in(course, "time_s");
  Chart chart{
      .title = "error of each frame over all separations",
      .x_title = "time, s",
      .y_title = "error, times the usual",
      .series = {{.name = "over 5 s", .x = time_s, .y = numbers_in(course, "smoothed"), .colour = "orange"},
                 {.name = "of each frame",
                  .x = time_s,
                  .y = numbers_in(course, "relative"),
                  .colour = "grey",
                  .width_px = 0.8}},
      .x_range = std::array{0.0, end_s},
      .zoomable = true,
      .size = "wide"};
  if (const std::optional<double> limit = number_in(course, "limit")) {
    chart.series.push_back(
        {.name = "limit", .x = {0, end_s}, .y = {*limit, *limit}, .colour = "green", .dash = {7, 5}});
  }
  for (Band band :
       {Band{.name = "left out: high error", .colour = "ochre", .spans = spans_in(data, "high")},
        Band{.name = "standing", .colour = "grey", .spans = spans_in(data, "standing")}, turn_band(turns)}) {
    if (!band.spans.empty()) chart.bands.push_back(std::move(band));
  }
  return chart;
}

Chart mean_chart(const ordered_json& data) {
  const ordered_json &rest = member(data, "of_the_rest"), &all = member(data, "of_all");
  return {.title = "mean error against separation",
          .x_title = "separation, s",
          .y_title = "mean error, deviations",
          .series = {{.name = "without what is left out",
                      .x = numbers_in(rest, "seconds"),
                      .y = numbers_in(rest, "error"),
                      .colour = "blue",
                      .mark = "circle"},
                     {.name = "of all frames",
                      .x = numbers_in(all, "seconds"),
                      .y = numbers_in(all, "error"),
                      .colour = "grey",
                      .dash = {5, 4}}}};
}

std::optional<Chart> relation_chart(const ordered_json& data) {
  const ordered_json& relation = member(data, "relation");
  if (relation.empty()) return {};
  return Chart{.title = "learned relation",
               .x_title = "error, deviations",
               .y_title = "visual motion, s at mean speed",
               .series = {{.name = "mean errors",
                           .x = numbers_in(relation, "knot_error"),
                           .y = numbers_in(relation, "knot_separation"),
                           .colour = "blue",
                           .line = false,
                           .mark = "circle",
                           .size_px = 5},
                          {.name = "second-order spline",
                           .x = numbers_in(relation, "error"),
                           .y = numbers_in(relation, "separation"),
                           .colour = "green"}}};
}

}  // namespace

Band turn_band(const std::vector<vo::WalkedTurn>& turns) {
  Band band{.name = "turn", .colour = "purple", .spans = {}};
  for (const vo::WalkedTurn& turn : turns) band.spans.emplace_back(turn.begin_s, turn.end_s);
  return band;
}

void put_alignment(Page& page, const ordered_json& data, const std::vector<vo::WalkedTurn>& turns) {
  constexpr double kMost_s = 1e10;  // steps along an axis have to count
  const std::optional<double> end = number_in(data, "end_s");
  const std::vector<double> seconds = numbers_in(data, "seconds");
  if (!end || !(*end > 0 && *end <= kMost_s) || seconds.empty()) return;
  const double end_s = *end;
  put_pictures(page, data);
  page.heading("Alignment error");
  std::optional<std::string> heat = picture_in(data, "heat");
  if (heat && seconds.front() > 0) {
    page.chart(heat_chart(std::move(*heat), end_s, seconds.front(), seconds.size()),
               "How much each frame differs from those up to 0.4 s later: bright is much. It grows with the "
               "separation alike in every frame [SSS Fig. 1b].");
  }
  page.chart(
      course_chart(data, turns, end_s),
      "The mean over all separations, as a multiple of the usual one. Where it is above the limit over "
      "5 s, frames are left out of learning [SSS Fig. 10].");
  page.begin_row();
  page.chart(mean_chart(data), "It flattens where frames no longer have much in common [SSS Fig. 2].");
  page.chart("", relation_chart(data),
             "What an error between neighbouring frames is worth in motion: the part of the mean curve that "
             "rises, turned over [SSS Fig. 3].");
  page.end_row();
}

}  // namespace retrace

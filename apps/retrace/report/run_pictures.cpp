#include "run_pictures.hpp"

#include "json_file.hpp"
#include "report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <nlohmann/json.hpp>

namespace retrace {
using nlohmann::ordered_json;

namespace {

/// Pictures that are part of the page; a figure shows nothing from elsewhere.
ordered_json pictures_in(const ordered_json& json, std::initializer_list<const char*> names) {
  ordered_json pictures = ordered_json::object();
  for (const char* name : names) {
    const std::optional<std::string> source = text_in(json, name);
    if (source && source->starts_with("data:image/")) pictures[name] = *source;
  }
  return pictures;
}

}  // namespace

std::vector<MatrixFigure> matrix_figures(const RunView& run) {
  std::vector<MatrixFigure> figures;
  for (std::size_t i = 0; i < run.traverses.size(); ++i) {
    ordered_json pictures = pictures_in(member(run.data["traverses"][i], "pictures"), {"enhanced", "raw"});
    const std::vector<double>& frames = run.traverses[i].frame;
    if (pictures.empty() || frames.empty()) continue;
    const std::vector<double> keyframe = upto(frames.size());
    ordered_json matches = ordered_json::array(), truth = ordered_json::array();
    for (std::size_t q = 0; q < run.matches.size(); ++q) {
      const place::Match& match = run.matches[q];
      ordered_json reference;
      if (match.place && match.place->traverse == run.traverses[i].name)
        reference = std::lround(interpolated(frames, keyframe, static_cast<double>(match.place->frame)));
      matches.push_back({{"query", q},
                         {"frame", match.query_frame},
                         {"time_s", rounded(match.query_time_s)},
                         {"reference", reference},
                         {"score", rounded(match.score)},
                         {"accepted", match.accepted}});
      if (q >= run.true_frame.size()) continue;
      const std::optional<double>& frame = run.true_frame[q];
      truth.push_back(frame ? rounded(interpolated(frames, keyframe, *frame)) : nullptr);
    }
    ordered_json spec{{"queries", run.matches.size()},
                      {"references", frames.size()},
                      {"reference_frames", rounded(frames)},
                      {"pictures", std::move(pictures)},
                      {"matches", std::move(matches)}};
    if (!run.true_frame.empty()) spec["truth"] = std::move(truth);
    figures.push_back({run.traverses[i].name, json_text(spec)});
  }
  return figures;
}

std::optional<std::string> strip_json(const RunView& run) {
  const ordered_json& pairs = member(run.data, "pairs");
  if (!pairs.is_array()) return {};
  ordered_json spec{{"unit", "m"}, {"pairs", ordered_json::array()}};
  if (run.truth != nullptr && run.truth->unit == place::ErrorUnit::kFrames) spec["unit"] = "frames";
  for (const ordered_json& stored : pairs) {
    const auto q = static_cast<std::size_t>(count_in(stored, "keyframe").value_or(-1));
    if (q >= run.matches.size() || !run.matches[q].place) continue;
    const place::Match& match = run.matches[q];
    ordered_json pair = pictures_in(stored, {"query", "reference"});
    pair["keyframe"] = q;
    pair["query_frame"] = match.query_frame;
    pair["time_s"] = rounded(match.query_time_s);
    pair["reference_frame"] = match.place->frame;
    pair["reference_time_s"] = rounded(match.place->time_s);
    pair["score"] = rounded(match.score);
    pair["accepted"] = match.accepted;
    if (run.truth != nullptr && run.truth->errors[q].error) {
      pair["error"] = rounded(*run.truth->errors[q].error);
      pair["right"] = *run.truth->errors[q].error <= run.truth->tolerance;
    }
    spec["pairs"].push_back(std::move(pair));
  }
  if (spec["pairs"].empty()) return {};
  return json_text(spec);
}

}  // namespace retrace

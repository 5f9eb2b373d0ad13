#include "run_pictures.hpp"

#include "report/chart.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace retrace {
using nlohmann::ordered_json;

std::vector<MatrixFigure> matrix_figures(const RunView& run) {
  std::vector<MatrixFigure> figures;
  for (std::size_t i = 0; i < run.traverses.size(); ++i) {
    const ordered_json& traverse = run.data["traverses"][i];
    if (!traverse.contains("pictures") || traverse["pictures"].empty()) continue;
    const std::vector<double>& frames = run.traverses[i].frame;
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
                      {"reference_frames", traverse["frame"]},
                      {"pictures", traverse["pictures"]},
                      {"matches", std::move(matches)}};
    if (!run.true_frame.empty()) spec["truth"] = std::move(truth);
    figures.push_back({run.traverses[i].name, spec.dump()});
  }
  return figures;
}

std::optional<std::string> strip_json(const RunView& run) {
  if (!run.data.contains("pairs")) return {};
  ordered_json spec{{"unit", "m"}, {"pairs", ordered_json::array()}};
  if (run.truth != nullptr && run.truth->unit == place::ErrorUnit::kFrames) spec["unit"] = "frames";
  for (const ordered_json& stored : run.data["pairs"]) {
    const auto q = stored["keyframe"].get<std::size_t>();
    if (q >= run.matches.size() || !run.matches[q].place) continue;
    const place::Match& match = run.matches[q];
    ordered_json pair = stored;
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
  return spec.dump();
}

}  // namespace retrace

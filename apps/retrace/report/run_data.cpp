#include "run_data.hpp"

#include "json_file.hpp"
#include "report/matrix_picture.hpp"
#include "report/page.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <nlohmann/json.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kPairs = 240;  // 2 MB of previews at most

template <typename Range, typename Project>
ordered_json column(const Range& range, Project project) {
  ordered_json values = ordered_json::array();
  for (const auto& element : range) values.push_back(rounded(project(element)));
  return values;
}

ordered_json traverse_json(const place::Traverse& traverse) {
  const auto& keyframes = traverse.keyframes;
  using place::Keyframe;
  return {{"name", traverse.name},
          {"frame", column(keyframes, [](const Keyframe& k) { return static_cast<double>(k.frame); })},
          {"time_s", column(keyframes, [](const Keyframe& k) { return k.time_s; })},
          {"displacement", column(keyframes, [](const Keyframe& k) { return k.displacement; })},
          {"distance_m", column(keyframes, [](const Keyframe& k) { return k.distance_m.value_or(NAN); })},
          {"x_m", column(keyframes, [](const Keyframe& k) { return k.pose ? k.pose->x_m : NAN; })},
          {"y_m", column(keyframes, [](const Keyframe& k) { return k.pose ? k.pose->y_m : NAN; })},
          {"pictures", ordered_json::object()}};
}

/// Displacement travelled so far, at each frame of the query.
ordered_json query_json(const vo::Walk& walk, const place::SampledWalk& sampled) {
  std::vector<double> travelled(sampled.displacement.size());
  std::partial_sum(sampled.displacement.begin(), sampled.displacement.end(), travelled.begin());
  ordered_json frames = ordered_json::array();
  for (const std::size_t frame : sampled.frames) frames.push_back(frame);
  return {{"frame", frames},
          {"time_s", travelled.empty() ? ordered_json::array() : rounded(walk.time_s)},
          {"displacement", rounded(travelled)}};
}

/// The surest accepted, the least sure accepted and refused, and otherwise evenly spaced ones along the walk.
std::set<std::size_t> chosen_matches(const std::vector<place::Match>& matches) {
  std::vector<std::size_t> by_score;
  for (std::size_t q = 0; q < matches.size(); ++q) {
    if (matches[q].place) by_score.push_back(q);
  }
  if (by_score.size() <= kPairs) return {by_score.begin(), by_score.end()};
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < kPairs / 2; ++i) chosen.insert(by_score[i * by_score.size() / (kPairs / 2)]);
  std::ranges::stable_sort(by_score, {}, [&](std::size_t q) { return matches[q].score; });
  std::size_t refused = 0, accepted = 0;
  for (const std::size_t q : by_score) {
    std::size_t& count = matches[q].accepted ? accepted : refused;
    if (++count <= kPairs / 6) chosen.insert(q);
  }
  chosen.insert(by_score.end() - static_cast<std::ptrdiff_t>(kPairs / 6), by_score.end());
  return chosen;
}

ordered_json pairs_json(const place::Route& route, const vo::Walk& walk,
                        const std::vector<place::Match>& matches) {
  ordered_json pairs = ordered_json::array();
  for (const std::size_t q : chosen_matches(matches)) {
    const place::Match& match = matches[q];
    const auto traverse = std::ranges::find(route.traverses, match.place->traverse, &place::Traverse::name);
    const auto& reference = traverse->keyframes[match.place->keyframe].preview_jpeg;
    ordered_json pair{{"keyframe", q}};
    if (!walk.previews.empty())
      pair["query"] = data_url(walk.previews[static_cast<std::size_t>(match.query_frame)]);
    if (!reference.empty()) pair["reference"] = data_url(reference);
    if (pair.size() > 1) pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

ordered_json run_data(const place::Route& route, const vo::Walk& walk, const place::Run& run,
                      const std::vector<KeptMatrix>& matrices) {
  ordered_json json{{"motion", run.settings.motion.value_or("none")},
                    {"unit", run.sampled.unit},
                    {"query", query_json(walk, run.sampled)},
                    {"traverses", ordered_json::array()},
                    {"pairs", pairs_json(route, walk, run.matches)}};
  for (std::size_t i = 0; i < route.traverses.size(); ++i) {
    ordered_json traverse = traverse_json(route.traverses[i]);
    if (i < matrices.size() && !matrices[i].enhanced.values.empty()) {
      traverse["pictures"]["enhanced"] = data_url(cost_picture(matrices[i].enhanced));
      traverse["pictures"]["raw"] = data_url(cost_picture(matrices[i].cost));
    }
    json["traverses"].push_back(std::move(traverse));
  }
  return json;
}

ordered_json read_run_data(const std::filesystem::path& folder) {
  return read_json_object(folder / kRunDataFile);
}

}  // namespace retrace

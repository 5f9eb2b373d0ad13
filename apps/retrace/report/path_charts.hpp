#pragma once

#include "report/chart.hpp"
#include "report/run_view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace retrace {

/// A run with its name in a figure that shows several.
struct NamedRun {
  std::string name;
  const RunView* run = nullptr;
};

// Each returns none if the runs lack what it would show. The path is the true one if it is known, else that
// of accepted matches.
/// The path of one run through its matrix, by keyframes and by time, as fixed sampling would have it (SSS
/// Fig. 7), and how far each is from a straight line.
std::optional<Chart> straightness_chart(const RunView& run);
/// The paths of several runs by their own keyframes.
std::optional<Chart> path_chart(const std::vector<NamedRun>& runs);
/// Where the keyframes of both walks lie on the route, and where as many would lie at a fixed rate (SSS Fig.
/// 6); needs the truth.
std::optional<Chart> sampling_chart(const RunView& run);
/// The keyframes of several runs on the route.
std::optional<Chart> sampling_chart(const std::vector<NamedRun>& runs);

}  // namespace retrace

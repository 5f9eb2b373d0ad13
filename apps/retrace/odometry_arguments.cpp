#include "odometry_arguments.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {

void declare_odometry_settings(Arguments& arguments, place::Settings& settings,
                               const std::vector<std::string>& without) {
  std::vector<std::string> left_out{
      "every",           "spacing-m",           "sampling-n",        "tie-scale",
      "motion-file",     "motion-file-start-s", "motion-file-gap-s", "axes",
      "preview-width-px"};
  left_out.insert(left_out.end(), without.begin(), without.end());
  using enum place::SettingGroup;
  arguments.settings(settings, {kReading, kMotion, kOdometry, kGeneral}, left_out);
}

std::vector<Argument> declare_segments(Arguments& arguments, place::OdometryEvaluationOptions& evaluation,
                                       const std::string& what) {
  std::vector<Argument> options{arguments.option("--segments", evaluation.segments, what + " [PVO 5.2]"),
                                arguments.option("--segment-m", evaluation.segment_m,
                                                 "metres of a segment [PVO 5.2: 50 indoors, 100 outdoors]"),
                                arguments.option("--seed", evaluation.seed, "of the segments' starts")};
  options[0].range(1, 1e6);
  options[1].range(5, 1e6);
  return options;
}

void check_one_for_each(const std::string& option, std::size_t files, std::size_t walks) {
  if (files == walks) return;
  throw vo::Error(option, fmt::format("names {} files for {} walks", files, walks),
                  "one for each, in their order");
}

}  // namespace retrace

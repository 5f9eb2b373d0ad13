#pragma once

#include "arguments.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include <place/evaluation/odometry_evaluation.hpp>
#include <place/settings.hpp>

/// What the commands about odometry have in common.
namespace retrace {

/// The settings that odometry uses: no keyframes are sampled, and motion comes from no file. `without`:
/// further ones to leave out.
void declare_odometry_settings(Arguments& arguments, place::Settings& settings,
                               const std::vector<std::string>& without = {});

/// The random segments that errors are measured on (PVO 5.2). `what`: whose they are, for --help. Returns the
/// options.
std::vector<Argument> declare_segments(Arguments& arguments, place::OdometryEvaluationOptions& evaluation,
                                       const std::string& what);

/// Throws `vo::Error` unless the option names one file for each walk.
void check_one_for_each(const std::string& option, std::size_t files, std::size_t walks);

}  // namespace retrace

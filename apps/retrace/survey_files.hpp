#pragma once

#include "arguments.hpp"

#include <optional>
#include <string>

#include <place/route/route.hpp>
#include <place/route/survey.hpp>
#include <vo/odometry.hpp>

namespace retrace {

/// The file with a traverse's positions: at most one of three.
struct SurveyFiles {
  std::string truth;
  std::string trajectory;
  std::string track;
  std::string track_name;
  std::optional<double> trajectory_start_s, track_start_s;

  bool operator==(const SurveyFiles&) const = default;
};

void declare_survey(Arguments& arguments, SurveyFiles& files);

/// The settings without those that only the survey uses. `motion_of_route` applies if `settings` give no
/// motion, as motion from a file uses them too.
place::Settings settings_beside(const SurveyFiles& files, place::Settings settings,
                                const std::optional<std::string>& motion_of_route);

/// Reads the survey; none if no file was given. Throws `vo::Error` if it cannot be read, or is not of the
/// same kind as the route's. A first GPS track gives the route its origin.
std::optional<place::Survey> read_survey(const SurveyFiles& files, const place::Settings& settings,
                                         const vo::Walk& walk, place::Route& route);

}  // namespace retrace

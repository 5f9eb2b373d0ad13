#pragma once

#include "arguments.hpp"
#include "survey_files.hpp"

#include <string>
#include <vector>

#include <place/route/route.hpp>
#include <place/settings.hpp>

namespace retrace {

/// What `retrace build` was told.
struct BuildOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;  ///< one, maybe of several files; or else
  std::string import;             ///< a folder with a route
  std::string output;
  std::string name;  ///< of the traverse
  SurveyFiles survey;
  std::string places;
  std::string report;
};

/// Called before any work is done. Throws `vo::Error` unless there is either a walk or a folder alone, and if
/// the route or the report cannot be written. A traverse without a name gets the recording's, without folders
/// and extension.
void check_build(BuildOptions& options);

/// Throws `vo::Error` if the route has a traverse of that name and `force` is not given.
void check_name_is_free(const BuildOptions& options, const place::Route& route);

}  // namespace retrace

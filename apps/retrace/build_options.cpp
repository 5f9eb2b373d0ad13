#include "build_options.hpp"

#include "command.hpp"
#include "run_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

std::string name_of_recording(const std::string& walk) {
  std::filesystem::path path(walk);
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  return path.stem().string();
}

void check_report(const BuildOptions& options) {
  std::error_code ignored;
  const auto real = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored);
  };
  if (real(options.report) == real(options.output))
    throw vo::Error(options.report, "is the route itself", "another file for --report");
  check_new_file(options.report, options.common.force, "another file");
}

}  // namespace

void check_build(BuildOptions& options) {
  if (!options.import.empty()) {
    if (!options.walk.empty() || !options.name.empty() || options.settings != place::Settings{} ||
        options.survey != SurveyFiles{} || !options.places.empty() || !options.report.empty())
      throw UsageError(
          "--import: leaves no choice of a walk, a name, places, a survey, a report or settings; expected "
          "--output alone: all else is in the folder");
    return;
  }
  if (options.walk.empty())
    throw UsageError(fmt::format("walk: is missing; expected {}, or --import", kWalkArgument));
  check_writable(options.output);
  if (!options.report.empty()) check_report(options);
  if (options.name.empty()) options.name = name_of_recording(options.walk.front());
}

void check_name_is_free(const BuildOptions& options, const place::Route& route) {
  if (options.common.force ||
      std::ranges::find(route.traverses, options.name, &place::Traverse::name) == route.traverses.end())
    return;
  throw vo::Error(options.output, fmt::format("already has a traverse '{}'", options.name),
                  "another --name, or --force to replace it");
}

}  // namespace retrace

#include "walk_reading.hpp"

#include "progress_bar.hpp"

#include <spdlog/spdlog.h>

#include <place/place.hpp>

namespace retrace {

vo::Walk read_with_bar(const std::vector<std::string>& files, const place::Settings& settings) {
  ProgressBar bar(files.front());
  return place::read(files, settings, bar.callback());
}

vo::Walk read_with_bar(const std::vector<std::string>& files, const place::Route& route,
                       const place::Settings& settings) {
  ProgressBar bar(files.front());
  return place::read(files, route, settings, bar.callback());
}

vo::Walk read_with_bar(const std::vector<std::string>& files, const vo::WalkOptions& options) {
  ProgressBar bar(files.front());
  return vo::read_walk(files, options, bar.callback());
}

void log_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

}  // namespace retrace

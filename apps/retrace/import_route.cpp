#include "import_route.hpp"

#include "json_file.hpp"
#include "run_directory.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/route_folder.hpp>
#include <place/route/route_lock.hpp>
#include <vo/base/error.hpp>

namespace retrace {

void import_route(const std::string& folder, const std::string& output, const CommonOptions& common) {
  check_writable(output);
  const place::RouteLock lock(output);
  if (!common.force && std::filesystem::exists(output))
    throw vo::Error(output, "already exists", "another name, or --force to overwrite");
  const place::Route route = place::read_route_folder(folder);
  lock.write(route);
  const std::size_t traverses = route.traverses.size();
  if (common.json) {
    fmt::print("{}\n", json_text({{"route", output}, {"traverses", traverses}}, 2));
  } else {
    fmt::print("{}: {} traverse{} from {}\n", output, traverses, traverses == 1 ? "" : "s", folder);
  }
}

}  // namespace retrace

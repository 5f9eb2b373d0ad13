#include "command.hpp"
#include "json_file.hpp"
#include "route_contents.hpp"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/route_database.hpp>
#include <place/route/route_folder.hpp>

namespace retrace {

std::function<void()> declare_inspect(Arguments& arguments) {
  struct InspectOptions {
    CommonOptions common;
    std::string route, folder;
  };
  auto options = std::make_shared<InspectOptions>();
  arguments.positional("route", options->route, "route database");
  arguments.option("--export", options->folder,
                   "new folder to write all of it into: pictures, CSV and NumPy arrays [none]");
  arguments.json(options->common);
  arguments.footer(
      "Examples:\n  retrace inspect route.db --json\n"
      "  retrace inspect route.db --export folder    (`retrace build --import folder` reads it back)");
  return [options] {
    const place::Route route = place::read_route(options->route);
    if (!options->folder.empty()) place::write_route_folder(options->folder, route);
    if (options->common.json) {
      fmt::print("{}\n", json_text(route_json(options->route, route), 2));
    } else {
      print_route(options->route, route);
      if (!options->folder.empty()) fmt::print("\nwritten into {}\n", options->folder);
    }
  };
}

}  // namespace retrace

#include "command.hpp"
#include "route_contents.hpp"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/route_database.hpp>

namespace retrace {

std::function<void()> declare_inspect(Arguments& arguments) {
  struct InspectOptions {
    CommonOptions common;
    std::string route;
  };
  auto options = std::make_shared<InspectOptions>();
  arguments.positional("route", options->route, "route database");
  arguments.json(options->common);
  arguments.footer("Example:\n  retrace inspect route.db --json");
  return [options] {
    const place::Route route = place::read_route(options->route);
    if (options->common.json) {
      fmt::print("{}\n", route_json(options->route, route).dump(2));
    } else {
      print_route(options->route, route);
    }
  };
}

}  // namespace retrace

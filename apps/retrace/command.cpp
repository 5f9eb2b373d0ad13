#include "command.hpp"

namespace retrace {

void add_config_option(CLI::App& app, CommonOptions& options) {
  app.add_option("--config", options.config, "TOML file of settings; flags come on top")->group("General");
}

void add_force_option(CLI::App& app, CommonOptions& options) {
  app.add_flag("--force", options.force, "overwrite what is there")->group("General");
}

void add_json_option(CLI::App& app, CommonOptions& options) {
  app.add_flag("--json", options.json, "print the result as JSON")->group("General");
}

}  // namespace retrace

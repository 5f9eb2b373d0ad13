#include "command.hpp"
#include "run_directory.hpp"
#include "settings.hpp"

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include <vo/io/atomic_file.hpp>

namespace retrace {

Command add_config(CLI::App& root) {
  auto output = std::make_shared<std::string>();
  CLI::App* app =
      root.add_subcommand("config", "write all settings with their defaults, as TOML for --config");
  app->add_option("-o,--output", *output, "file to write instead of standard output");
  app->footer("Example:\n  retrace config -o my.toml");
  return {app, [output] {
            if (output->empty()) {
              fmt::print("{}", to_toml({}));
              return;
            }
            check_writable(*output);
            vo::write_file(*output, to_toml({}));
          }};
}

}  // namespace retrace

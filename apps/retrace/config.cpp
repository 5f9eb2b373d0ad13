#include "command.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include <vo/io/atomic_file.hpp>

namespace retrace {

std::function<void()> declare_config(Arguments& arguments) {
  auto output = std::make_shared<std::string>();
  arguments.option("-o,--output", *output, "file to write instead of standard output");
  arguments.footer("Example:\n  retrace config -o my.toml");
  return [output] {
    if (output->empty()) {
      fmt::print("{}", to_toml({}));
      return;
    }
    check_writable(*output);
    vo::write_file(*output, to_toml({}));
  };
}

}  // namespace retrace

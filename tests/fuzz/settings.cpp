// A file of settings (--config, and config.toml of a run).
#include "fuzz.hpp"
#include "settings_file.hpp"

#include <cstdlib>
#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::write("settings.toml", {data, size}).string();
  fuzz::call(size, [&] {
    const place::Settings settings = retrace::read_settings_file(file);
    if (size % 8 != 0) return;  // writing all settings takes most of the time
    // What was read can be written, and is the same when it is read again.
    std::ofstream(file) << retrace::to_toml(settings);
    if (retrace::read_settings_file(file) != settings) std::abort();
  });
  return 0;
}

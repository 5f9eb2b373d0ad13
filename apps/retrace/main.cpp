#include "command_line.hpp"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <string_view>
#include <unistd.h>

#include <fmt/format.h>

#include <place/version.hpp>

/// Answers --version by itself; for anything else loads the module next to it.
int main(int argc, char** argv) {
  if (argc == 2 && argv[1] == std::string_view("--version")) {
    fmt::print("retrace {}\n", place::kVersion);
    return std::fflush(stdout) == 0 ? 0 : 1;
  }
  // Read when the OpenMP runtime is loaded with the module: its threads sleep while they wait, and leave the
  // processor to the video decoder. The user's own settings take precedence.
  setenv("OMP_WAIT_POLICY", "passive", 0);
  void* const module = dlopen(RETRACE_COMMANDS, RTLD_LAZY);
  void* const run = module != nullptr ? dlsym(module, "retrace_run") : nullptr;
  if (run == nullptr) {
    fmt::print(stderr, "retrace: {}\n", dlerror());
    return 1;
  }
  const int code = reinterpret_cast<decltype(&retrace::retrace_run)>(run)(argc, argv);
  // Without the destructors of 230 libraries: there is nothing left to do, and some abort where memory is
  // short.
  std::fflush(nullptr);
  ::_exit(code);
}

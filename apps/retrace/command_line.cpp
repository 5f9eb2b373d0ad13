#include "command_line.hpp"

#include "command.hpp"
#include "config_file.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <place/version.hpp>
#include <vo/base/error.hpp>

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

/// The file after --config, if there is one; its settings are parsed before the command line's, which so come
/// on top.
std::string config_file_in(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    constexpr std::string_view kFlag = "--config";
    if (arguments[i] == kFlag && i + 1 < arguments.size()) return arguments[i + 1];
    if (arguments[i].starts_with("--config=")) return arguments[i].substr(kFlag.size() + 1);
  }
  return {};
}

/// CLI11 writes the upper bound of "positive" out, with its 309 digits.
std::string without_endless_bounds(std::string message) {
  const std::size_t range = message.find(" not in range "), bound = message.find(" to 179769");
  if (range != std::string::npos && bound != std::string::npos)
    message.replace(range, std::string::npos, ": expected a positive number");
  return message;
}

/// The nearest flag of the command to the first that it does not have.
std::string hint_for(const CLI::App& root) {
  const auto chosen = root.get_subcommands();
  const CLI::App& app = chosen.empty() ? root : *chosen.front();
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  if (chosen.empty()) {
    for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(command->get_name());
    }
  }
  for (const std::string& argument : root.remaining(true)) {
    const std::string nearest = retrace::nearest_name(argument.substr(0, argument.find('=')), names);
    if (!nearest.empty()) return fmt::format("; did you mean {}?", nearest);
  }
  return {};
}

int run(int argc, char** argv) {
  CLI::App root("retrace: where you are on a route you have walked before, from video alone", "retrace");
  root.set_version_flag("--version", fmt::format("retrace {}", place::kVersion));
  root.set_help_all_flag("--help-all", "show the help of every command");
  root.require_subcommand(1);
  root.footer(
      "Examples:\n"
      "  retrace demo -o demo    (draws two walks and finds one on the other; no data needed)\n"
      "  retrace build day.mp4 -o route.db\n"
      "  retrace localise night.mp4 --route route.db -o run\n"
      "  retrace evaluate run --pairs pairs.csv --tolerance-frames 17");
  const std::vector<retrace::Command> commands{
      retrace::add_demo(root),     retrace::add_build(root),
      retrace::add_localise(root), retrace::add_correct(root),
      retrace::add_evaluate(root), retrace::add_sweep(root),
      retrace::add_compare(root),  retrace::add_inspect(root),
      retrace::add_odometry(root), retrace::add_evaluate_odometry(root),
      retrace::add_simulate(root), retrace::add_config(root)};

  std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    const std::string config = config_file_in(arguments);
    const auto command = std::ranges::find_if(commands, [&](const retrace::Command& candidate) {
      return !arguments.empty() && candidate.app->get_name() == arguments.front();
    });
    if (!config.empty() && command != commands.end()) {
      const auto from_file = retrace::arguments_from_config(config, *command->app);
      arguments.insert(arguments.begin() + 1, from_file.begin(), from_file.end());
    }
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    root.parse(reversed);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return root.exit(error);
    fmt::print(stderr, "retrace: {}{}\n", without_endless_bounds(error.what()), hint_for(root));
    fmt::print(stderr, "Run `retrace {}--help` for more.\n",
               root.get_subcommands().empty() ? "" : root.get_subcommands().front()->get_name() + " ");
    return kUsage;
  }
  for (const retrace::Command& command : commands) {
    if (command.app->parsed()) command.run();
  }
  if (std::fflush(stdout) != 0) throw vo::Error("standard output", "cannot be written");
  return 0;
}

}  // namespace

namespace retrace {

extern "C" int retrace_run(int argc, char** argv) {
#if defined(__GLIBC__)
  // Frames come and go by the thousand: memory given back to the system would be faulted in again for each.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
  // FFmpeg and OpenCV print to stderr on their own; what matters of it reaches the user through our messages.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);  // frames are spread over threads, so what is done within one is not
  spdlog::set_default_logger(spdlog::stderr_logger_st("retrace"));
  spdlog::set_pattern("retrace: %l: %v");
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit then is a failed write with its reason, not a kill
  try {
    return run(argc, argv);
  } catch (const vo::Error& error) {
    fmt::print(stderr, "retrace: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "retrace: out of memory; fewer frames or a smaller --thumbnail-width expected\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "retrace: internal error: {}\n", error.what());
  }
  return kFailed;
}

}  // namespace retrace

#include "command_line.hpp"

#include "command.hpp"
#include "interruption.hpp"
#include "launched_team.hpp"
#include "shell_documents.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <new>
#include <string>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <place/version.hpp>
#include <vo/base/error.hpp>
#include <vo/io/partial_path.hpp>

namespace retrace {
namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

struct CommandEntry {
  const char* name;
  const char* description;
  Declare* declare;
};

constexpr std::array kCommands{
    CommandEntry{"demo",
                 "draw a street by day and by night, and find the one walk on the other; needs no data",
                 declare_demo},
    CommandEntry{"doctor", "look at a recording, and say whether it is fit to be a reference",
                 declare_doctor},
    CommandEntry{"build", "make a route database of a walk, or add a traverse to one", declare_build},
    CommandEntry{"localise", "find a walk on a route: a position for every keyframe of it", declare_localise},
    CommandEntry{"follow", "say where on a route a walker is, frame by frame, as a line of JSON",
                 declare_follow},
    CommandEntry{
        "correct",
        "the corrected trajectory of a run again, after its matches were edited or from other odometry",
        declare_correct},
    CommandEntry{"evaluate", "precision, recall and errors of a run against the truth", declare_evaluate},
    CommandEntry{"sweep", "which settings find a walk on another best, by precision and recall",
                 declare_sweep},
    CommandEntry{"compare", "precision and recall of several runs of one walk, and how sure they are",
                 declare_compare},
    CommandEntry{"video", "a video of a run: the query, and below it the place where it was found",
                 declare_video},
    CommandEntry{"inspect", "show what is in a route database", declare_inspect},
    CommandEntry{"describe", "write the descriptors of a walk's keyframes, for other programs",
                 declare_describe},
    CommandEntry{"odometry", "steps, headings and the trajectory of a walk", declare_odometry},
    CommandEntry{"evaluate-odometry", "steps and trajectory of a walk against the truth",
                 declare_evaluate_odometry},
    CommandEntry{"sweep-odometry", "which settings follow walks best, by the truth about them",
                 declare_sweep_odometry},
    CommandEntry{"simulate", "draw the video of a walk, and its truth at every frame", declare_simulate},
    CommandEntry{"config", "write all settings with their defaults, as TOML for --config", declare_config},
};

/// A command as declared to CLI11.
struct Declared {
  CLI::App* app;
  Arguments arguments;
  std::function<void()> run;
};

std::deque<Declared> declare_all(CLI::App& root, bool all) {
  std::deque<Declared> commands;
  for (const CommandEntry& entry : kCommands) {
    CLI::App* app = root.add_subcommand(entry.name, entry.description);
    Declared& declared = commands.emplace_back(Declared{app, Arguments(*app, all), {}});
    declared.run = entry.declare(declared.arguments);
  }
  return commands;
}

/// The completions of a shell, or a page of the manual, from the declarations.
void add_documents(CLI::App& root, const CLI::App& documented) {
  CLI::App* completion = root.add_subcommand("completion", "write the completions of a shell");
  auto shell = std::make_shared<std::string>();
  completion->add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->footer(
      "Example:\n  retrace completion bash > ~/.local/share/bash-completion/completions/retrace");
  completion->callback([shell, &documented] {
    fmt::print("{}", *shell == "bash" ? bash_completion(documented) : zsh_completion(documented));
  });
  CLI::App* manual = root.add_subcommand("manual", "write a page of the manual");
  auto command = std::make_shared<std::string>();
  manual->add_option("command", *command, "of which command; without, of the program");
  manual->footer("Example:\n  retrace manual localise | man -l -");
  manual->callback([command, &documented] { fmt::print("{}", manual_page(documented, *command)); });
}

/// CLI11 prints the upper bound of "positive" with all its 309 digits.
std::string without_endless_bounds(std::string message) {
  const std::size_t range = message.find(" not in range "), bound = message.find(" to 179769");
  if (range != std::string::npos && bound != std::string::npos)
    message.replace(range, std::string::npos, ": expected a positive number");
  return message;
}

/// The command's flag that is nearest to the first unknown one.
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
    const std::string nearest = place::nearest_name(argument.substr(0, argument.find('=')), names);
    if (!nearest.empty()) return fmt::format("; did you mean {}?", nearest);
  }
  return {};
}

void describe(CLI::App& root) {
  root.set_version_flag("--version", fmt::format("retrace {}", place::kVersion));
  root.set_help_all_flag("--help-all", "show every setting of every command");
  root.require_subcommand(1);
  root.footer(
      "Examples:\n"
      "  retrace demo -o demo    (draws two walks and finds one on the other; no data needed)\n"
      "  retrace build day.mp4 -o route.db\n"
      "  retrace localise night.mp4 --route route.db -o run\n"
      "  retrace evaluate run --pairs pairs.csv --tolerance-frames 17");
}

int run(int argc, char** argv) {
  constexpr const char* kAbout = "retrace: where you are on a route you have walked before, from video alone";
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool all = std::ranges::find(arguments, "--help-all") != arguments.end();
  CLI::App root(kAbout, "retrace");
  describe(root);
  std::deque<Declared> commands = declare_all(root, all);
  CLI::App documented(kAbout, "retrace");
  describe(documented);
  const std::deque<Declared> documented_commands = declare_all(documented, true);
  add_documents(root, documented);
  add_documents(documented, documented);

  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    root.parse(reversed);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return root.exit(error);
    fmt::print(stderr, "retrace: {}{}\n", without_endless_bounds(error.what()), hint_for(root));
    fmt::print(stderr, "Run `retrace {}--help` for more.\n",
               root.get_subcommands().empty() ? "" : root.get_subcommands().front()->get_name() + " ");
    return kUsage;
  }
  for (Declared& command : commands) {
    if (!command.app->parsed()) continue;
    try {
      const std::string& name = command.app->get_name();
      if (is_launched() && name != "localise")
        throw UsageError(fmt::format("mpirun has no effect on {}; expected one process{}", name,
                                     name == "sweep" ? ", or several with --cell" : ""));
      command.arguments.finish();
      command.run();
    } catch (const UsageError& error) {
      fmt::print(stderr, "retrace: {}\nRun `retrace {} --help` for more.\n", error.what(),
                 command.app->get_name());
      return kUsage;
    }
  }
  if (std::fflush(stdout) != 0) throw vo::Error("standard output", "cannot be written");
  return 0;
}

constexpr const char* kOutOfMemory =
    "retrace: out of memory; expected a shorter walk, or --memory for a search of a long route\n";

int run_or_say_why(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const vo::Error& error) {
    fmt::print(stderr, "retrace: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, kOutOfMemory);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) {
      fmt::print(stderr, kOutOfMemory);
    } else {
      fmt::print(stderr, "retrace: internal error: {} in {}\n", error.err, error.func);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "retrace: internal error: {}\n", error.what());
  }
  return kFailed;
}

}  // namespace

extern "C" int retrace_run(int argc, char** argv) {
#if defined(__GLIBC__)
  // Thousands of frames are allocated and freed: memory returned to the system would be faulted in again for
  // each.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
  // FFmpeg and OpenCV print to stderr on their own; what matters reaches the user through our messages.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);  // frames are spread over threads, so work within a frame is not
  spdlog::set_default_logger(spdlog::stderr_logger_st("retrace"));
  spdlog::set_pattern("retrace: %l: %v");
  end_on_signals();
  std::atexit(vo::discard_partial_paths);  // libgomp ends the program where it gets no thread
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit then fails a write, with its reason, and kills nothing
  const int code = run_or_say_why(argc, argv);
  vo::discard_partial_paths();  // folders that were made for results and got none
  return code;
}

}  // namespace retrace

#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace retrace {

/// A subcommand: its declaration, and what it does once its arguments are parsed.
struct Command {
  CLI::App* app = nullptr;
  std::function<void()> run;
};

Command add_odometry(CLI::App& root);
Command add_build(CLI::App& root);
Command add_localise(CLI::App& root);
Command add_correct(CLI::App& root);
Command add_evaluate(CLI::App& root);
Command add_evaluate_odometry(CLI::App& root);
Command add_sweep(CLI::App& root);
Command add_compare(CLI::App& root);
Command add_inspect(CLI::App& root);
Command add_simulate(CLI::App& root);
Command add_demo(CLI::App& root);
Command add_config(CLI::App& root);

/// Options that most commands share.
struct CommonOptions {
  std::string config;
  bool force = false;
  bool json = false;
};
void add_config_option(CLI::App& app, CommonOptions& options);
void add_force_option(CLI::App& app, CommonOptions& options);
void add_json_option(CLI::App& app, CommonOptions& options);

}  // namespace retrace

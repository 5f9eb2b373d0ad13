#pragma once

namespace retrace {

/// The whole program: parses the command line, runs the command, and returns the exit code. The launcher
/// finds it in the loaded module as "retrace_run".
extern "C" int retrace_run(int argc, char** argv);

}  // namespace retrace

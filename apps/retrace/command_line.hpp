#pragma once

namespace retrace {

/// The whole program: parses the command line, runs the command, and returns the exit code. Its name in the
/// module that the launcher loads is "retrace_run".
extern "C" int retrace_run(int argc, char** argv);

}  // namespace retrace

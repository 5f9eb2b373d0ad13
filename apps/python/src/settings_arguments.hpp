#pragma once

#include <functional>
#include <pybind11/pybind11.h>

#include <place/settings.hpp>
#include <vo/base/progress.hpp>

namespace retrace_python {

namespace py = pybind11;

/// Settings of keyword arguments: the names of the one table with underscores, values as Python has them.
/// Throws `vo::Error` naming a setting that there is not, or that does not take its value.
place::Settings settings_of(const py::kwargs& arguments);

/// Every setting as a dictionary of text, for `retrace.settings()`.
py::list settings_list();

/// Calls `progress(stage, done, total)`; nothing for None. For work that released the interpreter's lock.
vo::ProgressCallback progress_of(const py::object& progress);

}  // namespace retrace_python

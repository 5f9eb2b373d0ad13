#pragma once

#include <pybind11/pybind11.h>

namespace retrace_python {

void bind_matrices(pybind11::module_& module);
void bind_evaluation(pybind11::module_& module);
void bind_walks(pybind11::module_& module);
void bind_follower(pybind11::module_& module);

}  // namespace retrace_python

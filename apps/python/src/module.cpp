#include "bindings.hpp"
#include "settings_arguments.hpp"

#include <exception>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

PYBIND11_MODULE(_retrace, module) {
  namespace py = pybind11;
  module.doc() = "Speed-normalised sequence place recognition built on pedestrian odometry.";
  module.attr("__version__") = RETRACE_VERSION;
  py::register_exception<vo::Error>(module, "Error", PyExc_RuntimeError).doc() =
      "What was wrong with an input, where, and what was expected, in one line.";
  module.def("settings", &retrace_python::settings_list,
             "Every setting that functions take as a keyword: a list of dicts of name, group, default, "
             "description.");
  module.def("set_threads", &vo::set_thread_count, py::arg("count"),
             "Threads that all functions use together; 0: one for each core. Results do not depend on it.");
  retrace_python::bind_matrices(module);
  retrace_python::bind_walks(module);
  retrace_python::bind_evaluation(module);
  retrace_python::bind_follower(module);
}

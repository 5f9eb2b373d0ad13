#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <type_traits>

#include <vo/base/stopping.hpp>

namespace retrace_python {

namespace py = pybind11;

/// Calls `work()` without the interpreter's lock, and returns what it returns. Ten times a second the lock is
/// taken to see whether a signal has come: if its handler raises something, as that of Ctrl-C does, the work
/// ends and that is thrown. What `work` was to change must be as before if it ends so.
template <typename Work>
auto unlocked(const Work& work) {
  using Result = std::invoke_result_t<Work>;
  constexpr bool kNothing = std::is_void_v<Result>;
  std::optional<std::conditional_t<kNothing, char, Result>> result;
  std::optional<py::error_already_set> raised;
  const vo::Stopping stopping([&] {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() == 0) return false;
    raised.emplace();
    return true;
  });
  try {
    const py::gil_scoped_release released;
    if constexpr (kNothing) {
      work();
    } else {
      result.emplace(work());
    }
  } catch (const vo::Stopped&) {  // thrown below, as it is where the work was done before it noticed
  }
  if (raised) throw py::error_already_set(*raised);
  if constexpr (!kNothing) return std::move(*result);
}

}  // namespace retrace_python

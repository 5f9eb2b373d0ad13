#include "settings_arguments.hpp"

#include <string>

namespace retrace_python {
namespace {

std::string text_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value).cast<std::string>();
}

std::string python_name(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c == '-' ? '_' : c;
  return text;
}

}  // namespace

place::Settings settings_of(const py::kwargs& arguments) {
  place::Settings settings;
  for (const auto& [key, value] : arguments) {
    if (value.is_none()) continue;
    auto name = key.cast<std::string>();
    for (char& c : name) c = c == '_' ? '-' : c;
    if (name == "threads") throw py::value_error("threads: set_threads(count) expected");
    place::set(settings, place::setting_named(name), text_of(value));
  }
  return settings;
}

py::list settings_list() {
  py::list all;
  for (const place::Setting& setting : place::settings_table()) {
    if (setting.name == "threads") continue;  // `set_threads`
    py::dict entry;
    entry["name"] = python_name(setting.name);
    entry["group"] = std::string(place::name_of(setting.group));
    entry["default"] = std::string(setting.standard);
    entry["description"] = std::string(setting.description);
    all.append(entry);
  }
  return all;
}

vo::ProgressCallback progress_of(const py::object& progress) {
  if (progress.is_none()) return {};
  // The object lives as long as the call that it is given to.
  return [progress = progress.ptr()](const vo::Progress& now) {
    const py::gil_scoped_acquire lock;
    const py::object total = now.total ? py::object(py::int_(*now.total)) : py::object(py::none());
    const py::object go_on = py::handle(progress)(std::string(now.stage), now.done, total);
    return go_on.is_none() || go_on.cast<bool>();
  };
}

}  // namespace retrace_python

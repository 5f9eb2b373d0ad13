#include "arrays.hpp"

#include <limits>

namespace retrace_python {

CostsArgument::CostsArgument(const py::object& object) {
  if (py::isinstance<place::CostMatrix>(object)) {
    kept_ = object;
    matrix_ = *object.cast<const place::CostMatrix*>();
    return;
  }
  const auto array = Floats::ensure(object);
  if (!array || array.ndim() != 2) {
    PyErr_Clear();
    throw py::value_error("costs: a CostMatrix or an array of queries x references expected");
  }
  kept_ = array;
  matrix_ = {static_cast<std::size_t>(array.shape(0)),
             static_cast<std::size_t>(array.shape(1)),
             {array.data(), static_cast<std::size_t>(array.size())}};
}

vo::ImageStackView image_stack(const Bytes& array) {
  if (array.ndim() != 2 && array.ndim() != 3)
    throw py::value_error("an array (n, values) or (n, height, width) expected");
  return {static_cast<int>(array.shape(array.ndim() - 1)),
          array.ndim() == 3 ? static_cast<int>(array.shape(1)) : 1,
          {array.data(), static_cast<std::size_t>(array.size())}};
}

place::FloatRowsView float_rows(const Floats& array) {
  if (array.ndim() != 2) throw py::value_error("an array (n, values) expected");
  return {static_cast<std::size_t>(array.shape(1)), {array.data(), static_cast<std::size_t>(array.size())}};
}

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace retrace_python

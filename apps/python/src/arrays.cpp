#include "arrays.hpp"

#include <algorithm>
#include <limits>

namespace retrace_python {

CostsArgument::CostsArgument(const py::object& object) {
  if (py::isinstance<place::CostMatrix>(object)) {
    matrix_ = object.cast<const place::CostMatrix*>();
    return;
  }
  const auto array = Floats::ensure(object);
  if (!array || array.ndim() != 2) {
    PyErr_Clear();
    throw py::value_error("costs: a CostMatrix or an array of queries x references expected");
  }
  copy_ = place::make_cost_matrix(static_cast<std::size_t>(array.shape(0)),
                                  static_cast<std::size_t>(array.shape(1)));
  std::copy_n(array.data(), array.size(), copy_.values.begin());
  matrix_ = &copy_;
}

vo::ImageStack image_stack(const Bytes& array) {
  if (array.ndim() != 2 && array.ndim() != 3)
    throw py::value_error("an array (n, values) or (n, height, width) expected");
  const auto count = static_cast<std::size_t>(array.shape(0));
  const auto height = array.ndim() == 3 ? static_cast<int>(array.shape(1)) : 1;
  const auto width = static_cast<int>(array.shape(array.ndim() - 1));
  vo::ImageStack stack = vo::make_image_stack(width, height, count);
  std::copy_n(array.data(), array.size(), stack.pixels.begin());
  return stack;
}

place::FloatRows float_rows(const Floats& array) {
  if (array.ndim() != 2) throw py::value_error("an array (n, values) expected");
  return {.width = static_cast<std::size_t>(array.shape(1)),
          .values = std::vector<float>(array.data(), array.data() + array.size())};
}

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace retrace_python

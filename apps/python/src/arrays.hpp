#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <vector>

#include <place/describe/float_rows.hpp>
#include <place/match/costs.hpp>
#include <vo/image/image_stack.hpp>

/// numpy arrays for the libraries' data, and back.
namespace retrace_python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

/// A matrix for the libraries: the object's own if it is a `CostMatrix`, else a copy of an array of queries
/// by references. Throws `ValueError` for anything else.
class CostsArgument {
 public:
  explicit CostsArgument(const py::object& object);
  [[nodiscard]] const place::CostMatrix& matrix() const { return *matrix_; }

 private:
  place::CostMatrix copy_;
  const place::CostMatrix* matrix_ = nullptr;
};

/// Pictures or descriptors, one for each row: (n, values) or (n, height, width).
vo::ImageStack image_stack(const Bytes& array);
place::FloatRows float_rows(const Floats& array);

/// An array of the values; what is none becomes `none`.
template <typename Value, typename Of, typename Get>
py::array_t<Value> array_of(const std::vector<Of>& all, Get get) {
  py::array_t<Value> array(static_cast<py::ssize_t>(all.size()));
  Value* to = array.mutable_data();
  for (const Of& one : all) *to++ = get(one);
  return array;
}

py::array_t<double> array_of(const std::vector<double>& values);
double or_nan(const std::optional<double>& value);

}  // namespace retrace_python

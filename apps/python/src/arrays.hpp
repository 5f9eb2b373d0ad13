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

constexpr int kInOrder = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
using Floats = py::array_t<float, kInOrder | int{py::array::forcecast}>;
using Doubles = py::array_t<double, kInOrder | int{py::array::forcecast}>;
using Bytes = py::array_t<std::uint8_t, kInOrder>;

/// A matrix for the libraries, looked at where it is: a `CostMatrix`, or an array of queries by references.
/// An array that is not float32 in C's order is copied first. Throws `ValueError` for anything else.
class CostsArgument {
 public:
  explicit CostsArgument(const py::object& object);
  [[nodiscard]] const place::CostView& matrix() const { return matrix_; }

 private:
  py::object kept_;  ///< what the view looks at
  place::CostView matrix_;
};

/// Pictures or descriptors, one for each row: (n, values) or (n, height, width), looked at where they are.
vo::ImageStackView image_stack(const Bytes& array);
place::FloatRowsView float_rows(const Floats& array);

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

// A camera's calibration: YAML, XML or JSON.
#include "fuzz.hpp"

#include <vo/io/camera_calibration.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("camera.yaml", {data, size});
  fuzz::call(size, [&] { vo::read_camera_calibration(file); });
  return 0;
}

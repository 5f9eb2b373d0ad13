// The EXIF data of a picture; Exiv2, which parses them, is not instrumented.
#include "fuzz.hpp"

#include <vo/io/picture_tags.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("picture.jpg", {data, size});
  fuzz::call(size, [&] { vo::read_picture_tags(file); });
  return 0;
}

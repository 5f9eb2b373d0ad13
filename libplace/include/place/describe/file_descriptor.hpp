#pragma once

#include "place/describe/descriptor.hpp"

#include <memory>

namespace place {

/// Descriptors from a file, of any model: NumPy's .npy (`read_npy`), a row for each described frame, and
/// beside it a CSV of the same name with `.csv` behind it and the columns `frame,time_s`, as `retrace
/// describe` writes both. A keyframe takes the row of its frame, or of the nearest one described within half
/// a second. Throws `vo::Error` naming the file where there is none, or it cannot be read.
std::unique_ptr<Descriptor> make_file(const DescriptorOptions& options);

}  // namespace place

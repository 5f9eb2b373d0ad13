#pragma once

#include "place/describe/descriptor.hpp"

#include <memory>

namespace place {

/// Descriptors from a file, of any model: NumPy's .npy (`read_npy`), a row for each described frame, and next
/// to it a CSV of the same name with `.csv` appended and the columns `frame,time_s`. `retrace describe`
/// writes both. A keyframe takes the row of its frame, or of the nearest described frame within half a
/// second. Throws `vo::Error` naming the file if there is no such row or it cannot be read.
std::unique_ptr<Descriptor> make_file(const DescriptorOptions& options);

}  // namespace place

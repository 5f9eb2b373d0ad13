#pragma once

#include "place/describe/descriptor.hpp"

#include <memory>

namespace place {

/// The papers' descriptor: the walk's thumbnails, as they are in the route, patch-normalised (SSS Eq. 2) to
/// be compared by mean absolute difference. Keeps nothing besides the thumbnails that every walk has, and
/// learns nothing.
std::unique_ptr<Descriptor> make_thumbnail(const DescriptorOptions& options);

}  // namespace place

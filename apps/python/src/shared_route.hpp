#pragma once

#include <memory>

#include <place/route/route.hpp>

namespace retrace_python {

/// A route that threads may share: whoever reads it keeps what it was when he began, and whoever adds to it
/// puts another in its place.
struct SharedRoute {
  std::shared_ptr<const place::Route> now;
};

}  // namespace retrace_python

#pragma once

#include "sweep_files.hpp"

#include <vector>

namespace retrace {

/// The arguments that say what is swept, and what is compared of it.
void declare_swept(Arguments& arguments, SweepOptions& options);

/// The axes of the sweep: motion, sequence length (in keyframes or in metres), search range, and those of
/// --vary. Throws `vo::Error` if both lengths are given or a setting would vary twice.
std::vector<place::SweepAxis> swept_axes(const SweepOptions& options);

}  // namespace retrace

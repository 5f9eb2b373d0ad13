#pragma once

#include <cstddef>
#include <string>

namespace retrace {

/// "2G", "500M" in bytes. Throws `vo::Error` naming `--memory` for anything else.
std::size_t bytes_of(const std::string& text);

/// Keeps the process from taking more than that; what would is then refused as out of memory.
void limit_memory(std::size_t bytes);

}  // namespace retrace

#pragma once

#include "place/describe/column_stack.hpp"
#include "place/describe/descriptor.hpp"
#include "place/describe/standardise.hpp"

#include <span>

namespace place {

/// A spread as bytes for the route, and back.
Bytes pack_spread(const Spread& spread);
Spread unpack_spread(std::span<const std::uint8_t> bytes);

/// Rows of columns, standardised by their own spread and the learned one, as bytes. Throws `vo::Error` if
/// `learned` is of another size.
ColumnStack standardised_columns(FloatRows rows, std::span<const std::uint8_t> learned, int columns);

}  // namespace place

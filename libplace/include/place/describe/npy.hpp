#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/float_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace place {

/// Reads an array of NumPy's .npy format (versions 1 to 3): two dimensions, a row for each described frame,
/// of float32, float16, uint8 or int8, little-endian and in C order. Throws `vo::Error` naming the file and
/// what is wrong with it.
FloatRows read_npy(const std::filesystem::path& path);

/// Writes rows as float32, or bytes as uint8 or int8, `width` to a row; the file appears whole or not at all.
/// Throws `vo::Error` if it cannot be written, `std::invalid_argument` if the bytes are not whole rows.
void write_npy(const std::filesystem::path& path, const FloatRows& rows);
void write_npy(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::size_t width);
void write_npy(const std::filesystem::path& path, std::span<const std::int8_t> bytes, std::size_t width);

/// Writes descriptors, a row for each: pixels as uint8, columns and floats as float32. Returns the numbers in
/// a row. Throws as the others.
std::size_t write_npy(const std::filesystem::path& path, const Descriptors& descriptors);

}  // namespace place

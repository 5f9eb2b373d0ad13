#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the targets share. Each is one reader, called with what libFuzzer makes of the seeds.
namespace fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A folder of this process in memory (/dev/shm), empty at its start and removed at its end.
const std::filesystem::path& folder();

/// Writes a file of that name into the folder.
std::filesystem::path write(std::string_view name, Bytes bytes);

/// The parts of an input between lines of `%%`; always `count`, the last ones empty where there are fewer.
std::vector<Bytes> parts(Bytes input, std::size_t count);

/// Calls a reader. `vo::Error` with a message of one line is a fine answer to any input. Everything else that
/// it may do ends the process: another exception, what the sanitizers find, or more than 50 bytes of memory
/// at once for each byte of input beside `allowance`, which is for buffers that do not grow with the file.
void call(std::size_t input_bytes, const std::function<void()>& reader, std::size_t allowance = 192U << 10U);

/// Calls one of several readers of the same file, each with about as many inputs as the others: by their
/// size.
void call_one(std::size_t input_bytes, const std::vector<std::function<void()>>& readers,
              std::size_t allowance = 192U << 10U);

}  // namespace fuzz

#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/principal_axes.hpp"

#include <memory>
#include <span>
#include <vector>

namespace place {

/// What the `blocks` descriptor learns from the first traverse of a route.
struct BlocksModel {
  PrincipalAxes block_axes;             ///< of dense blocks
  std::vector<FloatRows> vocabularies;  ///< of blocks projected on those axes
  PrincipalAxes column_axes;            ///< of columns of VLAD, without a mean
  float step = 1;                       ///< of the bytes (`quantise`)
};

/// Learns from keyframes: `records` are cells of `gradient_cells`, packed. Blocks of a sample of them give
/// the axes and words; their columns give the column axes. Throws `std::invalid_argument` without records.
/// About a second of one core for 200 or more keyframes.
BlocksModel learn_blocks(std::span<const Bytes> records);

/// Descriptors of keyframes: dense blocks -> VLAD in 8 columns (Jegou et al. 2010), with each vocabulary ->
/// joint principal axes (Jegou and Chum 2012: several vocabularies average out the randomness of each) ->
/// bytes. 1024 bytes per keyframe. Throws `vo::Error` for records of another size. 1 ms of one core each.
ColumnStack describe_blocks(std::span<const Bytes> records, const BlocksModel& model);

/// A model as bytes, and back: 1.1 MB; numbers are rounded to half precision, those of the column axes to
/// bytes. `unpack_blocks` throws `vo::Error` for
/// bytes that are not a model.
Bytes pack_blocks(const BlocksModel& model);
BlocksModel unpack_blocks(std::span<const std::uint8_t> bytes);

/// The same as a `Descriptor`. Keeps 4100 bytes of every frame: 370 MB for an hour at 25 frames/s.
std::unique_ptr<Descriptor> make_blocks(const DescriptorOptions& options);

}  // namespace place

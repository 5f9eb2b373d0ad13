#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/float_rows.hpp"

#include <memory>
#include <span>

namespace place {

/// Averages of a grid of rows x columns x channels (channels first, as networks give it) over pool_rows x
/// pool_columns parts of equal size; cells on a border count for both parts by their share. Returns a row of
/// the parts' channels, column after column, top to bottom. O(out * covered). Throws `std::invalid_argument`
/// if sizes disagree.
std::vector<float> pool_grid(std::span<const float> grid, int channels, int rows, int columns, int pool_rows,
                             int pool_columns);

/// The output of a layer of a convolutional network, averaged over a grid, standardised over the walk
/// (`standardise`), in bytes, with a shift of a quarter of its columns (Suenderhauf et al. 2015: middle
/// layers recognise places in different light). Uses OpenCV's dnn module: ONNX, Darknet, Caffe.
///
/// A JPEG of the network's input size is kept of every frame, about 15 kB, 1.4 GB for an hour at 25 frames/s,
/// so that the network runs on keyframes only. `learn` and `describe` throw `vo::Error`, in one line that
/// says what to do, for a model that is missing or cannot be read, a missing layer, or an unsupported input
/// or operator.
std::unique_ptr<Descriptor> make_network(const DescriptorOptions& options);

}  // namespace place

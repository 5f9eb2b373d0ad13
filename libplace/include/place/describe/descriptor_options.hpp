#pragma once

#include <array>
#include <optional>
#include <string>

#include <vo/image/patch_normalisation.hpp>

namespace place {

/// How rows of floats are compared; less is more alike.
enum class Metric {
  kCosine,  ///< 1 - cosine
  kL1,      ///< mean absolute difference
  kL2,      ///< Euclidean distance
};

/// Settings of the `network` descriptor.
struct NetworkOptions {
  std::string model;                          ///< ONNX, Darknet weights or Caffe model
  std::string model_config;                   ///< Darknet's .cfg, Caffe's .prototxt
  std::string layer;                          ///< whose output is taken; empty: the last
  int input_width = 320, input_height = 320;  ///< pixels
  int pool_rows = 5, pool_columns = 20;       ///< the output is averaged to so many cells
  double scale = 1 / 255.0;                   ///< a pixel's value is multiplied by this, after ...
  std::array<double, 3> mean{};               ///< ... these are taken off, in the network's order of channels
  bool swap_rb = true;                        ///< the network takes red first
};

/// Settings of the `file` descriptor.
struct DescriptorFileOptions {
  std::string path;                 ///< NumPy's .npy: a row for each described frame; beside it .csv
  Metric metric = Metric::kCosine;  ///< of its rows
};

/// Which descriptor, and what each asks for.
struct DescriptorOptions {
  std::string name = "blocks";          ///< or several joined by '+'
  std::optional<int> max_shift_px;      ///< of a picture 64 wide; not given: the descriptor's own
  vo::PatchNormalisationOptions patch;  ///< of `thumbnail`
  NetworkOptions network;
  DescriptorFileOptions file;
};

}  // namespace place

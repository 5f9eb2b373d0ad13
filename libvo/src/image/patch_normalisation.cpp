#include "vo/image/patch_normalisation.hpp"

#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vo {
namespace {

/// Sums of a rectangle of the image and of its squares, by summed-area tables.
class PatchSums {
 public:
  PatchSums(std::span<const std::uint8_t> image, int width, int height)
      : width_(width), height_(height), stride_(width + 1) {
    sums_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 1));
    for (int y = 0; y < height; ++y) {
      Moments row;
      for (int x = 0; x < width; ++x) {
        const std::int64_t value = image[static_cast<std::size_t>(y) * width + x];
        row.sum += value;
        row.square += value * value;
        const Moments& above = at(x + 1, y);
        at(x + 1, y + 1) = {above.sum + row.sum, above.square + row.square};
      }
    }
  }

  /// Mean and population deviation over [x0, x1) x [y0, y1).
  struct Statistics {
    double mean, deviation;
  };
  Statistics over(int x0, int y0, int x1, int y1) {
    const Moments &a = at(x0, y0), &b = at(x1, y0), &c = at(x0, y1), &d = at(x1, y1);
    const std::int64_t count = static_cast<std::int64_t>(x1 - x0) * (y1 - y0);
    const std::int64_t sum = d.sum - b.sum - c.sum + a.sum;
    const std::int64_t square = d.square - b.square - c.square + a.square;
    const auto n = static_cast<double>(count);
    // In integers up to the last step, so a constant patch has exactly no deviation.
    return {static_cast<double>(sum) / n, std::sqrt(static_cast<double>(count * square - sum * sum)) / n};
  }

  /// The median deviation of the cells of a grid, cut at the right and lower border.
  double median_deviation(int side) {
    std::vector<double> deviations;
    for (int y = 0; y < height_; y += side) {
      for (int x = 0; x < width_; x += side) {
        deviations.push_back(over(x, y, std::min(width_, x + side), std::min(height_, y + side)).deviation);
      }
    }
    const auto median = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
    std::ranges::nth_element(deviations, median);
    return *median;
  }

 private:
  struct Moments {
    std::int64_t sum = 0, square = 0;
  };
  Moments& at(int x, int y) { return sums_[static_cast<std::size_t>(y) * stride_ + x]; }

  int width_;
  int height_;
  int stride_;
  std::vector<Moments> sums_;
};

void check(std::size_t pixels, int width, int height, const PatchNormalisationOptions& options) {
  if (width < 1 || height < 1 ||
      pixels != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("patch_normalise: width * height bytes expected");
  }
  if (options.patch_px < 2) throw std::invalid_argument("patch_normalise: patch_px must be >= 2");
  if (!(options.min_deviation > 0))
    throw std::invalid_argument("patch_normalise: min_deviation must be positive");
  if (!(options.min_contrast >= 0)) throw std::invalid_argument("patch_normalise: min_contrast must be >= 0");
  if (options.shape == PatchShape::kGrid &&
      (width % options.patch_px != 0 || height % options.patch_px != 0)) {
    throw std::invalid_argument("patch_normalise: width and height must be multiples of patch_px");
  }
}

}  // namespace

void patch_normalise(std::span<const std::uint8_t> image, int width, int height,
                     const PatchNormalisationOptions& options, std::span<float> out) {
  check(image.size(), width, height, options);
  if (out.size() != image.size())
    throw std::invalid_argument("patch_normalise: out must be as large as the image");
  PatchSums sums(image, width, height);
  const double floor =
      std::max(options.min_deviation, options.min_contrast * sums.median_deviation(options.patch_px));
  const auto normalise = [&](int x, int y, const PatchSums::Statistics& patch) {
    const std::size_t k = static_cast<std::size_t>(y) * width + x;
    out[k] = static_cast<float>((image[k] - patch.mean) / std::max(patch.deviation, floor));
  };

  const int side = options.patch_px;
  if (options.shape == PatchShape::kGrid) {
    for (int y0 = 0; y0 < height; y0 += side) {
      for (int x0 = 0; x0 < width; x0 += side) {
        const PatchSums::Statistics patch = sums.over(x0, y0, x0 + side, y0 + side);
        for (int y = y0; y < y0 + side; ++y) {
          for (int x = x0; x < x0 + side; ++x) normalise(x, y, patch);
        }
      }
    }
    return;
  }
  const int half = side / 2;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      normalise(x, y,
                sums.over(std::max(0, x - half), std::max(0, y - half), std::min(width, x + half + 1),
                          std::min(height, y + half + 1)));
    }
  }
}

std::vector<double> patch_contrast(const ImageStack& images, int patch_px) {
  if (patch_px < 2) throw std::invalid_argument("patch_contrast: patch_px must be >= 2");
  std::vector<double> contrast(images.size());
  parallel_for(images.size(), [&](std::size_t i) {
    contrast[i] = PatchSums(images[i], images.width, images.height).median_deviation(patch_px);
  });
  return contrast;
}

ImageStack patch_normalise(const ImageStack& images, const PatchNormalisationOptions& options) {
  ImageStack normalised = make_image_stack(images.width, images.height, images.size());
  if (images.empty()) return normalised;
  check(images.image_size(), images.width, images.height, options);
  parallel_for(images.size(), [&](std::size_t i) {
    std::vector<float> deviations(images.image_size());
    patch_normalise(images[i], images.width, images.height, options, deviations);
    std::ranges::transform(deviations, normalised[i].begin(), [](float z) {
      const long byte = std::lround(kNeutralByte + kStepsPerDeviation * z);
      return static_cast<std::uint8_t>(std::clamp(byte, 0L, 255L));
    });
  });
  return normalised;
}

}  // namespace vo

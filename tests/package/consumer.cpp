#include <algorithm>
#include <cstdio>
#include <vector>

#include <place/match/cost_matrix.hpp>
#include <place/route/resampling.hpp>
#include <place/version.hpp>
#include <vo/image/image_stack.hpp>
#include <vo/image/patch_normalisation.hpp>

int main() {
  vo::ImageStack thumbnails = vo::make_image_stack(8, 8, 1);
  std::ranges::fill(thumbnails.pixels, 7);
  const vo::ImageStack descriptors = vo::patch_normalise(thumbnails, {});
  const place::CostMatrix cost = place::cost_matrix(descriptors, descriptors);
  const std::vector<double> displacement(10, 1.0);
  const bool right = cost.at(0, 0) == 0 && place::resample(displacement, 3).size() == 4;
  std::printf("retrace %.*s: %s\n", static_cast<int>(place::kVersion.size()), place::kVersion.data(),
              right ? "ok" : "WRONG");
  return right ? 0 : 1;
}

#include "kernels/dot_product.hpp"

#if defined(__aarch64__)

#include "kernels/dot_product_tiles.hpp"
#include "lanes/neon.hpp"

namespace place::kernels {

const DotKernels& neon_dot_kernels() {
  return kDotTable<vo::lanes::Neon, 6, 4>;
}

}  // namespace place::kernels

#endif

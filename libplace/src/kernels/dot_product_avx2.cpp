#include "kernels/dot_product.hpp"

#if defined(__x86_64__)

#include "kernels/dot_product_tiles.hpp"
#include "lanes/avx2.hpp"

namespace place::kernels {

const DotKernels& avx2_dot_kernels() {
  return kDotTable<vo::lanes::Avx2, 6, 2>;
}

}  // namespace place::kernels

#endif

#include "kernels/dot_product.hpp"

#if defined(__x86_64__)

#include "kernels/dot_product_tiles.hpp"
#include "lanes/avx512.hpp"

namespace place::kernels {

const DotKernels& vnni_dot_kernels() {
  return kDotTable<vo::lanes::Avx512Vnni, 12, 2>;
}

}  // namespace place::kernels

#endif

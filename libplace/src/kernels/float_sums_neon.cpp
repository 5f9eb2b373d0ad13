#include "kernels/float_sums.hpp"

#if defined(__aarch64__)

#include "kernels/float_sums_tiles.hpp"
#include "lanes/neon.hpp"

namespace place::kernels {

const FloatKernels& neon_float_kernels() {
  return kFloatTable<vo::lanes::Neon, 6, 4>;
}

}  // namespace place::kernels

#endif

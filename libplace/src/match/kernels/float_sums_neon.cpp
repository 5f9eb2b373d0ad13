#include "match/kernels/float_sums.hpp"

#if defined(__aarch64__)

#include "lanes/neon.hpp"
#include "match/kernels/float_sums_tiles.hpp"

namespace place::kernels {

const FloatKernels& neon_float_kernels() {
  return kFloatTable<vo::lanes::Neon, 6, 4>;
}

}  // namespace place::kernels

#endif

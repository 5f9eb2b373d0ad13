#include "kernels/float_sums.hpp"

#if defined(__x86_64__)

#include "kernels/float_sums_tiles.hpp"
#include "lanes/avx512.hpp"

namespace place::kernels {

const FloatKernels& avx512_float_kernels() {
  return kFloatTable<vo::lanes::Avx512, 12, 2>;
}

}  // namespace place::kernels

#endif

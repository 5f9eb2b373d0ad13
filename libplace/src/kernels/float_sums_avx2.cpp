#include "kernels/float_sums.hpp"

#if defined(__x86_64__)

#include "kernels/float_sums_tiles.hpp"
#include "lanes/avx2.hpp"

namespace place::kernels {

const FloatKernels& avx2_float_kernels() {
  return kFloatTable<vo::lanes::Avx2, 6, 2>;
}

}  // namespace place::kernels

#endif

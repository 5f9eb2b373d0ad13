#include "kernels/line_sums.hpp"

#if defined(__x86_64__)

#include "kernels/line_sums_table.hpp"
#include "lanes/avx512.hpp"

namespace place::kernels {

const LineKernels& avx512_line_kernels() {
  return kLineTable<vo::lanes::Avx512>;
}

}  // namespace place::kernels

#endif

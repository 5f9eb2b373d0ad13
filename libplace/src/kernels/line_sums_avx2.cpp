#include "kernels/line_sums.hpp"

#if defined(__x86_64__)

#include "kernels/line_sums_table.hpp"
#include "lanes/avx2.hpp"

namespace place::kernels {

const LineKernels& avx2_line_kernels() {
  return kLineTable<vo::lanes::Avx2>;
}

}  // namespace place::kernels

#endif

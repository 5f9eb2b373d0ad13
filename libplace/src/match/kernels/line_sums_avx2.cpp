#include "match/kernels/line_sums.hpp"

#if defined(__x86_64__)

#include "lanes/avx2.hpp"
#include "match/kernels/line_sums_table.hpp"

namespace place::kernels {

const LineKernels& avx2_line_kernels() {
  return kLineTable<vo::lanes::Avx2>;
}

}  // namespace place::kernels

#endif

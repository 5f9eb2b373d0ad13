#include "match/kernels/line_sums.hpp"

#if defined(__x86_64__)

#include "lanes/avx512.hpp"
#include "match/kernels/line_sums_table.hpp"

namespace place::kernels {

const LineKernels& avx512_line_kernels() {
  return kLineTable<vo::lanes::Avx512>;
}

}  // namespace place::kernels

#endif

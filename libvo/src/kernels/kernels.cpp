#include "kernels/kernels.hpp"

#include "kernels/table.hpp"
#include "lanes/plain.hpp"

namespace vo::kernels {

const Kernels& scalar_kernels() {
  return kTable<lanes::Plain<kLanes>>;
}

const Kernels& kernels() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return avx2_kernels();
#endif
  return scalar_kernels();
}

}  // namespace vo::kernels

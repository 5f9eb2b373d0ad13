// Compiled with -mavx2 (CMakeLists.txt), so it must not instantiate anything that other sources share: a
// linker that kept this file's copy would take AVX2 to processors without it.
#include "kernels/kernels.hpp"

#if defined(__x86_64__)

#include "kernels/table.hpp"
#include "lanes/avx2.hpp"

namespace vo::kernels {

const Kernels& avx2_kernels() {
  return kTable<lanes::Avx2>;
}

}  // namespace vo::kernels

#endif

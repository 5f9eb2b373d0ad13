#include "kernels/path_rows_table.hpp"

namespace place::kernels {

const PathKernels& plain_path_kernels() {
  return kPathTable;
}

const PathKernels& path_kernels() {
#if defined(__x86_64__)
  static const PathKernels& fastest =
      __builtin_cpu_supports("avx2") ? avx2_path_kernels() : plain_path_kernels();
  return fastest;
#else
  return plain_path_kernels();
#endif
}

}  // namespace place::kernels

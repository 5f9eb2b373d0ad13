#include "kernels/path_rows_table.hpp"

#if defined(__x86_64__)

namespace place::kernels {

const PathKernels& avx2_path_kernels() {
  return kPathTable;
}

}  // namespace place::kernels

#endif

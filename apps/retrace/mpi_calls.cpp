#include "mpi_calls.hpp"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

namespace {

void gather_numbers(std::int64_t mine, std::int64_t* all) {
  MPI_Allgather(&mine, 1, MPI_INT64_T, all, 1, MPI_INT64_T, MPI_COMM_WORLD);
}

void gather_bytes(const void* mine, int count, void* all, const int* counts, const int* starts,
                  bool to_everyone) {
  if (to_everyone) {
    MPI_Allgatherv(mine, count, MPI_BYTE, all, counts, starts, MPI_BYTE, MPI_COMM_WORLD);
  } else {
    MPI_Gatherv(mine, count, MPI_BYTE, all, counts, starts, MPI_BYTE, 0, MPI_COMM_WORLD);
  }
}

void end() {
  MPI_Finalize();
}

void abort_all() {
  MPI_Abort(MPI_COMM_WORLD, 1);
}

}  // namespace

// An MPI call that fails ends all processes, which is MPI's default.
const MpiCalls* retrace_mpi_begin() {
  static MpiCalls calls{0, 0, gather_numbers, gather_bytes, end, abort_all};
  MPI_Init(nullptr, nullptr);
  MPI_Comm_size(MPI_COMM_WORLD, &calls.size);
  MPI_Comm_rank(MPI_COMM_WORLD, &calls.rank);
  return &calls;
}

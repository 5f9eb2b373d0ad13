#pragma once

#include <cstdint>

/// What a team needs of MPI, as plain functions: the module that has them is loaded only where the program
/// was started by mpirun, so that nothing else depends on MPI.
extern "C" {

struct MpiCalls {
  int size;
  int rank;
  /// Gives everyone everyone's number.
  void (*gather_numbers)(std::int64_t mine, std::int64_t* all);
  /// Gives everyone, or the first alone, everyone's bytes: `counts` of each, which go to `starts`.
  void (*gather_bytes)(const void* mine, int count, void* all, const int* counts, const int* starts,
                       bool to_everyone);
  void (*end)();
  /// Ends all processes at once, where they cannot be told in order.
  void (*abort)();
};

/// Starts MPI. The name of the function in the module: `retrace_mpi_begin`.
using BeginMpi = const MpiCalls*();
const MpiCalls* retrace_mpi_begin();

}  // extern "C"

# Compiles the kernels for 64-bit Arm and runs their test on an emulated processor.
#   cmake -DCOMPILER=<cross compiler> -DEMULATOR=<of the processor> -DROOT=<the project's> -DWORK=<folder to use> -P run.cmake
file(MAKE_DIRECTORY ${WORK})
foreach(kernel absolute_difference dot_product float_sums)
  list(APPEND kernels ${ROOT}/libplace/src/kernels/${kernel}.cpp ${ROOT}/libplace/src/kernels/${kernel}_neon.cpp)
endforeach()
execute_process(
  COMMAND ${COMPILER} -std=c++20 -O3 -ffp-contract=off -Wall -Wextra -Werror -static -I${ROOT}/libplace/src -I${ROOT}/libvo/src
          ${ROOT}/tests/neon/neon_test.cpp ${kernels} -o ${WORK}/neon_test
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${EMULATOR} ${WORK}/neon_test COMMAND_ERROR_IS_FATAL ANY)

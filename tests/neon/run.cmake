# Compiles the kernels for 64-bit Arm and runs their test on an emulated processor.
#   cmake -DCOMPILER=<cross compiler> -DEMULATOR=<of the processor> -DROOT=<the project's> -DWORK=<folder to use> -P run.cmake
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${COMPILER} -std=c++20 -O3 -Wall -Wextra -Werror -static -I${ROOT}/libplace/src
          ${ROOT}/tests/neon/neon_test.cpp ${ROOT}/libplace/src/match/kernels/absolute_difference.cpp
          ${ROOT}/libplace/src/match/kernels/absolute_difference_neon.cpp -o ${WORK}/neon_test
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${EMULATOR} ${WORK}/neon_test COMMAND_ERROR_IS_FATAL ANY)

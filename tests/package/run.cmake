# Installs the built project to a folder of its own, then configures, builds and runs the consumer against it.
#   cmake -DBUILD=<build tree> -DSOURCE=<this folder> -DWORK=<folder to use> -P run.cmake
file(REMOVE_RECURSE ${WORK})
foreach(step
    "--install;${BUILD};--prefix;${WORK}/prefix"
    "-S;${SOURCE};-B;${WORK}/build;-G;Ninja;-DCMAKE_BUILD_TYPE=Release;-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "--build;${WORK}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE failed OUTPUT_QUIET)
  if(failed)
    message(FATAL_ERROR "step failed: cmake ${step}")
  endif()
endforeach()
foreach(program "${WORK}/build/consumer" "${WORK}/prefix/bin/retrace;--version")
  execute_process(COMMAND ${program} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "failed: ${program}")
  endif()
endforeach()

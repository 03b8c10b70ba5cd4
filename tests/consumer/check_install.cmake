# cmake -DBUILD_DIR= -DSOURCE_DIR= -DEXAMPLES_DIR= -DWORK_DIR= -DGENERATOR= -DCOMPILER= -DFLAGS= -DBUILD_TYPE= -P check_install.cmake
# Installs the build into an empty prefix, then configures, builds and runs the consumer and all
# examples against that prefix alone.

set(ENV{DESTDIR})
file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DEXAMPLES_DIR=${EXAMPLES_DIR})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
file(GLOB examples ${EXAMPLES_DIR}/*.cpp)
foreach(source IN LISTS examples)
  cmake_path(GET source STEM name)
  message(STATUS "example ${name}")
  run(${WORK_DIR}/build/${name})
endforeach()

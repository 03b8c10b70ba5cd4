# dwell_library(NAME PUBLIC ... PRIVATE ...): the static library dwell::NAME made of the sources of folder NAME.

function(dwell_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False in g++ 12 wherever strings are put together (its bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(DWELL_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# dwell_group_by_room(TARGET SOURCE...): with DWELL_UNITY, each folder of sources is compiled as one unit. Most of the time
# of a build goes into the headers of other people (Eigen above all), which a unit then reads once. A folder is a room, so
# that a new file touches its own room's unit only, and two files of one room may not define the same name.
function(dwell_group_by_room target)
  if(NOT DWELL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH room)
    cmake_path(RELATIVE_PATH room BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(REPLACE / _ room "${room}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
endfunction()

# Eigen's products are inline functions that differ with the compiler's flags, and the linker keeps one of each: all that
# is linked together must have the same. Where some sources have OpenMP and others do not, products are silently wrong:
# the threads of one half run the body of the other, each over all of the matrix. So no product has threads of its own,
# with or without OpenMP. And Eigen aligns its arrays by the instruction set. Both hold for users of the libraries too.
function(dwell_one_eigen target)
  target_compile_definitions(${target} PUBLIC EIGEN_DONT_PARALLELIZE)
  if(DWELL_NATIVE)
    target_compile_options(${target} PUBLIC -march=native)
  endif()
endfunction()

function(dwell_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_library(dwell_${name} STATIC ${sources})
  add_library(dwell::${name} ALIAS dwell_${name})
  set_target_properties(dwell_${name} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME dwell_${name})
  target_include_directories(dwell_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(dwell_${name} PUBLIC cxx_std_20)
  target_compile_definitions(dwell_${name} PRIVATE DWELL_VERSION="${PROJECT_VERSION}")
  dwell_one_eigen(dwell_${name})
  target_link_libraries(dwell_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  dwell_compile_options(dwell_${name})
  dwell_group_by_room(dwell_${name} ${sources})
endfunction()

# dwell_library(NAME PUBLIC ... PRIVATE ...): the static library dwell::NAME made of the sources of folder NAME.

function(dwell_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  if(DWELL_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
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
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/dwell>)
  target_compile_features(dwell_${name} PUBLIC cxx_std_20)
  target_compile_definitions(dwell_${name} PRIVATE DWELL_VERSION="${PROJECT_VERSION}")
  target_link_libraries(dwell_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(DWELL_NATIVE)
    # For users as well: Eigen aligns its arrays by the instruction set, so both sides must compile for the same one.
    target_compile_options(dwell_${name} PUBLIC -march=native)
  endif()
  dwell_compile_options(dwell_${name})
endfunction()

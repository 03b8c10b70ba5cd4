# Install and export: find_package(dwell) gives dwell::core, dwell::paths, dwell::solvers, dwell::runs.
include(CMakePackageConfigHelpers)

install(TARGETS dwell_core dwell_paths dwell_solvers dwell_runs EXPORT dwellTargets)
install(TARGETS dwell RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY data/templates DESTINATION ${CMAKE_INSTALL_DATADIR}/dwell)
install(CODE "set(source_dir ${PROJECT_SOURCE_DIR})
set(binary_dir ${PROJECT_BINARY_DIR})
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR})")
install(SCRIPT cmake/install_headers.cmake)

# Whoever takes the source tree with add_subdirectory() writes <dwell/core/...> as well: each of these headers leads to
# the one in the tree.
include(public_headers)
dwell_public_headers(public_headers ${PROJECT_SOURCE_DIR})
foreach(header IN LISTS public_headers)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/dwell/${header} CONTENT "#include \"${header}\"\n" @ONLY)
endforeach()

set(dwell_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dwell)
install(EXPORT dwellTargets NAMESPACE dwell:: DESTINATION ${dwell_cmake_dir})
configure_package_config_file(cmake/dwellConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/dwellConfig.cmake
                              INSTALL_DESTINATION ${dwell_cmake_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dwellConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dwellConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/dwellConfigVersion.cmake
              cmake/FindFFTW.cmake cmake/FindLBFGSB.cmake cmake/FindHDF5Serial.cmake cmake/FindCFITSIO.cmake cmake/FindCairo.cmake
              DESTINATION ${dwell_cmake_dir})

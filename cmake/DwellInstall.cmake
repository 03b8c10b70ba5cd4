# Install and export: find_package(dwell) gives dwell::core, dwell::paths, dwell::solvers, dwell::runs.
include(CMakePackageConfigHelpers)

install(TARGETS dwell_core dwell_paths dwell_solvers dwell_runs EXPORT dwellTargets)
install(TARGETS dwell RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(folder IN ITEMS core paths solvers runs)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dwell FILES_MATCHING PATTERN "*.h")
endforeach()

set(dwell_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dwell)
install(EXPORT dwellTargets NAMESPACE dwell:: DESTINATION ${dwell_cmake_dir})
configure_package_config_file(cmake/dwellConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/dwellConfig.cmake
                              INSTALL_DESTINATION ${dwell_cmake_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dwellConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dwellConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/dwellConfigVersion.cmake
              cmake/FindFFTW.cmake cmake/FindLBFGSB.cmake cmake/FindHDF5Serial.cmake cmake/FindCFITSIO.cmake cmake/FindCairo.cmake
              DESTINATION ${dwell_cmake_dir})

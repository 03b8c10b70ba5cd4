# CFITSIO::cfitsio. Debian's package has no CMake config.
find_path(CFITSIO_INCLUDE_DIR fitsio.h PATH_SUFFIXES cfitsio)
find_library(CFITSIO_LIBRARY cfitsio)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CFITSIO REQUIRED_VARS CFITSIO_INCLUDE_DIR CFITSIO_LIBRARY)

if(CFITSIO_FOUND AND NOT TARGET CFITSIO::cfitsio)
  add_library(CFITSIO::cfitsio UNKNOWN IMPORTED)
  set_target_properties(CFITSIO::cfitsio PROPERTIES IMPORTED_LOCATION ${CFITSIO_LIBRARY}
                                                    INTERFACE_INCLUDE_DIRECTORIES ${CFITSIO_INCLUDE_DIR})
endif()

# FFTW::double and FFTW::float, each with its OpenMP transforms. Debian's package has no usable CMake config.
find_path(FFTW_INCLUDE_DIR fftw3.h)
find_library(FFTW_DOUBLE_LIBRARY fftw3)
find_library(FFTW_DOUBLE_OMP_LIBRARY fftw3_omp)
find_library(FFTW_FLOAT_LIBRARY fftw3f)
find_library(FFTW_FLOAT_OMP_LIBRARY fftw3f_omp)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW REQUIRED_VARS FFTW_INCLUDE_DIR FFTW_DOUBLE_LIBRARY FFTW_DOUBLE_OMP_LIBRARY
                                  FFTW_FLOAT_LIBRARY FFTW_FLOAT_OMP_LIBRARY)

foreach(precision IN ITEMS double float)
  string(TOUPPER ${precision} upper)
  if(FFTW_FOUND AND NOT TARGET FFTW::${precision})
    add_library(FFTW::${precision} INTERFACE IMPORTED)
    target_include_directories(FFTW::${precision} INTERFACE ${FFTW_INCLUDE_DIR})
    target_link_libraries(FFTW::${precision} INTERFACE ${FFTW_${upper}_OMP_LIBRARY} ${FFTW_${upper}_LIBRARY})
  endif()
endforeach()

# LBFGSB::lbfgsb, the Fortran library L-BFGS-B 3.0. It has no header.
find_library(LBFGSB_LIBRARY lbfgsb)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LBFGSB REQUIRED_VARS LBFGSB_LIBRARY)

if(LBFGSB_FOUND AND NOT TARGET LBFGSB::lbfgsb)
  add_library(LBFGSB::lbfgsb UNKNOWN IMPORTED)
  set_target_properties(LBFGSB::lbfgsb PROPERTIES IMPORTED_LOCATION ${LBFGSB_LIBRARY})
endif()

# HDF5Serial::hdf5, the C library of HDF5 (without MPI) with its high-level part. CMake's own FindHDF5 needs the language
# C and the compiler wrappers; Debian keeps the serial library beside those for MPI, under names of their own.
find_path(HDF5SERIAL_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5SERIAL_LIBRARY NAMES hdf5_serial hdf5)
find_library(HDF5SERIAL_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5Serial REQUIRED_VARS HDF5SERIAL_INCLUDE_DIR HDF5SERIAL_LIBRARY
                                  HDF5SERIAL_HL_LIBRARY)

if(HDF5Serial_FOUND AND NOT TARGET HDF5Serial::hdf5)
  add_library(HDF5Serial::hdf5 INTERFACE IMPORTED)
  target_include_directories(HDF5Serial::hdf5 INTERFACE ${HDF5SERIAL_INCLUDE_DIR})
  target_link_libraries(HDF5Serial::hdf5 INTERFACE ${HDF5SERIAL_HL_LIBRARY} ${HDF5SERIAL_LIBRARY})
endif()

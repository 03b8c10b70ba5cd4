# Run by `cmake --install`, with source_dir, binary_dir and include_dir set: copies the public headers to
# <prefix>/include/dwell. In the tree they include each other as "core/...", which would need a folder of its own among
# the user's include paths and might meet another project's "core"; the copies say <dwell/core/...>.
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)
dwell_public_headers(headers ${source_dir})
foreach(header IN LISTS headers)
  file(READ ${source_dir}/${header} text)
  string(REGEX REPLACE "#include \"((core|paths|solvers|runs)/[^\"]+)\"" "#include <dwell/\\1>" text "${text}")
  set(copy ${binary_dir}/public_headers/dwell/${header})
  file(WRITE ${copy}.new "${text}")
  file(COPY_FILE ${copy}.new ${copy} ONLY_IF_DIFFERENT)
  cmake_path(GET header PARENT_PATH folder)
  file(INSTALL ${copy} DESTINATION ${CMAKE_INSTALL_PREFIX}/${include_dir}/dwell/${folder})
endforeach()

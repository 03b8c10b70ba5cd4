# Read by ctest when it starts, with `program` and `prefix` set by the file that includes this one: makes one test of
# every suite of a test program. A test of its own for each of the 1,500 tests would spend more time on starting
# processes than on testing; a suite that fails still prints which of its tests did, and one that crashes takes no other
# suite with it. Listed now and not while building, because a sanitizer needs the environment of the test preset.
if(NOT EXISTS ${program})
  add_test(${prefix}.NOT_BUILT ${program})
  return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed ERROR_VARIABLE errors RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${program} --gtest_list_tests: ${failed}\n${errors}")
endif()
string(REGEX MATCHALL "(^|\n)[^ \n][^ \n]*\\.[ \n]" suites "${listed}\n")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[ \n]" "" suite "${suite}")
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  add_test(${prefix}.${suite} ${program} --gtest_filter=${suite}.*)
  set_tests_properties(${prefix}.${suite} PROPERTIES TIMEOUT 1200)
endforeach()

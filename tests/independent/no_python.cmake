# Run in the place of a Python test where CMake found no Python: the lines that report_skips of ./dev looks for.
message(NOTICE "[  SKIPPED ] ${NAME} (0 ms)\ntests/independent: Skipped\nCMake found no python3")

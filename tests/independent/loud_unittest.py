"""Runs unittest cases and prints what GoogleTest would print.

`./dev test` looks for GoogleTest's lines of skipped tests in ctest's log and repeats them at the end. Printing the same
lines here makes a skipped check of this folder as loud as a skipped C++ test.
"""

import sys
import time
import unittest

SKIPPED = 77  # exit code that tests/independent/CMakeLists.txt names to ctest as SKIP_RETURN_CODE


def print_skip(name, reason):
    """Prints a skip as GoogleTest does: ./dev takes the name from the first line and the reason from the third."""
    print(f"[  SKIPPED ] {name} (0 ms)")
    print("tests/independent: Skipped")
    print(reason, flush=True)


def name_of(test):
    return f"{type(test).__name__}.{test.id().rpartition('.')[2].removeprefix('test_')}"


class LoudResult(unittest.TestResult):
    def startTest(self, test):
        super().startTest(test)
        self.started = time.monotonic()
        print(f"[ RUN      ] {name_of(test)}", flush=True)

    def addSuccess(self, test):
        super().addSuccess(test)
        print(f"[       OK ] {name_of(test)} ({1000 * (time.monotonic() - self.started):.0f} ms)", flush=True)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        print_skip(name_of(test), reason)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.print_last(self.failures, test)

    def addError(self, test, err):
        super().addError(test, err)
        self.print_last(self.errors, test)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            print(f"{subtest}:")
            self.print_last(self.failures if issubclass(err[0], test.failureException) else self.errors, test)

    def print_last(self, entries, test):
        print(entries[-1][1])
        print(f"[  FAILED  ] {name_of(test)}", flush=True)


def run_module(module_name, pattern=""):
    """Runs the tests of a module whose names hold `pattern`, and exits: 0, 1 after a failure, SKIPPED if none ran."""
    suite = unittest.TestSuite()
    for group in unittest.defaultTestLoader.loadTestsFromModule(sys.modules[module_name]):
        suite.addTests(test for test in group if pattern in name_of(test))
    result = LoudResult()
    suite.run(result)
    failed = len(result.failures) + len(result.errors)
    skipped = len(result.skipped)
    print(f"{result.testsRun - failed - skipped} passed, {failed} failed, {skipped} skipped")
    if failed or not result.testsRun:
        sys.exit(1)
    sys.exit(SKIPPED if skipped == result.testsRun else 0)


def skip_module(name, reason):
    """Ends the whole test program as skipped, for instance because a Python module that all of it needs is missing."""
    print_skip(name, reason)
    sys.exit(SKIPPED)

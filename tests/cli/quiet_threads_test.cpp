#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/cli/program_run.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

/// Sets a variable of the environment that the program inherits, and puts it back.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    if (before) before_ = before;
    had_ = before != nullptr;
    if (value) {
      setenv(name, value, 1);
    } else {
      unsetenv(name);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() {
    if (had_) {
      setenv(name_, before_.c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::string before_;
  bool had_ = false;
};

/// OMP_DISPLAY_ENV makes the OpenMP library write what it goes by when it is loaded.
TEST(QuietThreads, WaitAsleepUnlessTheUserSaysOtherwise) {
  const test::TemporaryFolder folder;
  const Variable display("OMP_DISPLAY_ENV", "verbose");
  {
    const Variable policy("OMP_WAIT_POLICY", nullptr), spin("GOMP_SPINCOUNT", nullptr);
    const test::ProgramResult result = test::run_program(folder.path(), {"--version"});
    EXPECT_EQ(result.exit_code, 0);
    test::expect_has(result.out, "dwell ");
    test::expect_has(result.err, "GOMP_SPINCOUNT = '0'");
  }
  for (const char* name : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"}) {
    const Variable policy("OMP_WAIT_POLICY", nullptr), spin("GOMP_SPINCOUNT", nullptr);
    const Variable users(name, name[0] == 'O' ? "active" : "1000");
    const test::ProgramResult result = test::run_program(folder.path(), {"--version"});
    EXPECT_EQ(result.exit_code, 0);
    test::expect_has(result.err, "GOMP_SPINCOUNT = ");
    EXPECT_EQ(result.err.find("GOMP_SPINCOUNT = '0'"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace dwell

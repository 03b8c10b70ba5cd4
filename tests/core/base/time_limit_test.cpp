#include "core/base/time_limit.h"

#include <gtest/gtest.h>

#include <thread>

namespace dwell {
namespace {

/// Works until it is told to stop.
int work_until_stopped(const Progress& progress) {
  progress.report("counting: 12 of 30");
  while (true) {
    progress.check();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(TimeLimit, EndsWorkThatAsksAndSaysWhereItWas) {
  const TimeLimit limit(0.05, "max solve");
  std::string shown;
  Progress progress;
  progress.show = [&](const std::string& line) { shown = line; };
  try {
    limit.run(progress, work_until_stopped);
    ADD_FAILURE() << "no TimeLimitReached";
  } catch (const TimeLimitReached& error) {
    EXPECT_STREQ(error.what(), "`max solve` of 0.05 s was over before the solve, at \"counting: 12 of 30\"");
  }
  EXPECT_EQ(shown, "counting: 12 of 30");
  EXPECT_LT(limit.left(), 0.0);
}

TEST(TimeLimit, SaysTheLimitAsStatedWhereLessThanTheLeast) {
  const TimeLimit limit(0.01, "max solve", 0.0, 0.05);
  EXPECT_GT(limit.left(), 0.01);
  try {
    limit.run({}, work_until_stopped);
    ADD_FAILURE() << "no TimeLimitReached";
  } catch (const TimeLimitReached& error) {
    EXPECT_STREQ(error.what(),
                 "`max solve` of 0.01 s (what comes before a solve has 0.05 s in any case) was over before the solve, "
                 "at \"counting: 12 of 30\"");
  }
}

TEST(TimeLimit, LeavesAnInterruptAndAResultAlone) {
  const TimeLimit limit(1000.0, "max solve");
  Progress progress;
  progress.stop = [] { return true; };
  EXPECT_THROW(limit.run(progress, work_until_stopped), Interrupted);
  EXPECT_EQ(limit.run({}, [](const Progress& p) { return p.check(), 7; }), 7);
  EXPECT_GT(limit.left(), 900.0);
  EXPECT_LE(limit.left(), 1000.0);
}

}  // namespace
}  // namespace dwell

#include "core/base/side_by_side.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dwell {
namespace {

TEST(SideBySide, RunsBothAtOnceOnHalfOfTheThreads) {
  std::promise<void> here, there;
  int of_first = 0, of_second = 0;
  // Each waits for the other: in turn, neither would come to an end.
  run_side_by_side(
      5, {},
      [&](const Progress&, int threads) {
        of_first = threads;
        here.set_value();
        there.get_future().wait();
      },
      [&](const Progress&, int threads) {
        of_second = threads;
        there.set_value();
        here.get_future().wait();
      });
  EXPECT_EQ(of_first, 3);
  EXPECT_EQ(of_second, 2);
}

TEST(SideBySide, RunsOneAfterTheOtherOnOneThread) {
  std::vector<int> order;
  const auto caller = std::this_thread::get_id();
  const auto side = [&](int name) {
    return [&order, &caller, name](const Progress&, int threads) {
      EXPECT_EQ(threads, 1);
      EXPECT_EQ(std::this_thread::get_id(), caller);
      order.push_back(name);
    };
  };
  run_side_by_side(1, {}, side(1), side(2));
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

/// Until the handle says stop.
void wait_for_stop(const Progress& progress) {
  for (;;) {
    progress.check();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(SideBySide, StopsTheOtherWhereOneThrowsAndThrowsThat) {
  const Side fails = [](const Progress&, int) { throw std::runtime_error("the reason"); };
  const Side waits = [](const Progress& progress, int) { wait_for_stop(progress); };
  for (const bool first : {true, false}) {
    try {
      run_side_by_side(2, {}, first ? fails : waits, first ? waits : fails);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "the reason");
    }
  }
}

TEST(SideBySide, StopsBothWhenAskedTo) {
  int asked = 0;
  Progress progress;
  progress.stop = [&asked] { return ++asked > 10; };
  const Side waits = [](const Progress& handle, int) { wait_for_stop(handle); };
  EXPECT_THROW(run_side_by_side(2, progress, waits, waits), Interrupted);
}

TEST(SideBySide, ShowsWhatBothReport) {
  std::vector<std::string> lines;
  Progress progress;
  progress.show = [&lines](const std::string& line) { lines.push_back(line); };
  const Side reports = [](const Progress& handle, int) {
    for (int i = 0; i < 1000; ++i) handle.report("a line");
  };
  run_side_by_side(2, progress, reports, reports);
  EXPECT_EQ(lines.size(), 2000U);
}

TEST(SideBySide, DoesEveryTaskOnce) {
  for (const int threads : {1, 2}) {
    std::vector<int> done(50, 0);  // each written by one thread
    run_side_by_side(threads, {}, done.size(), [&](std::size_t k, const Progress&) { ++done[k]; });
    EXPECT_EQ(done, std::vector<int>(50, 1));
  }
}

}  // namespace
}  // namespace dwell

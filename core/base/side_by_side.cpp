#include "core/base/side_by_side.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>

namespace dwell {
namespace {

class Pair {
 public:
  explicit Pair(const Progress& progress) : progress_(progress) {}

  void run(const Side& side, int threads) {
    try {
      side(shared(), threads);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      failed_ = true;
    }
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  Progress shared() {
    Progress progress;
    if (progress_.show) {
      progress.show = [this](const std::string& line) {
        const std::scoped_lock lock(mutex_);
        progress_.show(line);
      };
    }
    progress.stop = [this] {
      if (failed_) return true;
      const std::scoped_lock lock(mutex_);
      return progress_.stop_asked();
    };
    return progress;
  }

  const Progress& progress_;
  std::mutex mutex_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr thrown_;
};

}  // namespace

void run_side_by_side(int threads, const Progress& progress, const Side& first, const Side& second) {
  const int of_second = threads / 2;
  std::thread thread;
  Pair pair(progress);
  if (of_second > 0) {
    try {
      thread = std::thread([&] { pair.run(second, of_second); });
    } catch (const std::system_error&) {
      // Without it, it takes longer.
    }
  }
  if (thread.joinable()) {
    pair.run(first, threads - of_second);
    thread.join();
    pair.rethrow();
  } else {
    first(progress, threads);
    second(progress, threads);
  }
}

void run_side_by_side(int threads, const Progress& progress, std::size_t count,
                      const std::function<void(std::size_t k, const Progress& progress)>& task) {
  std::atomic<std::size_t> next = 0;
  const Side side = [&](const Progress& shared, int) {
    for (std::size_t k = next++; k < count; k = next++) {
      shared.check();
      task(k, shared);
    }
  };
  run_side_by_side(threads, progress, side, side);
}

}  // namespace dwell

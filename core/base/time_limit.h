#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/base/progress.h"

namespace dwell {

/// A computation was ended by the limit that the user set to its time, before there was anything to write. The command
/// line turns it into exit code 3.
class TimeLimitReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A limit on the wall clock, from its construction on, of work that asks a Progress.
class TimeLimit {
 public:
  /// `stated` is the limit as the user set it [s], `name` its option, as "max solve"; `used` is what went of it before
  /// [s]. Where `least` is more, the limit is that; messages give both.
  TimeLimit(double stated, std::string name, double used = 0.0, double least = 0.0);

  /// Since the beginning, with what was used before [s].
  double used() const;
  /// What is left [s]; negative when it is over.
  double left() const;

  /// Runs `work(Progress)`, which is to stop at the limit as well. Where that is why it stopped, throws
  /// TimeLimitReached with the option, the limit and the last news of the work; otherwise what the work throws.
  template <class Work>
  auto run(const Progress& progress, const Work& work) const {
    const auto news = std::make_shared<std::string>("the beginning");
    Progress limited;
    limited.show = [progress, news](const std::string& line) { progress.report(*news = line); };
    limited.stop = [progress, this] { return progress.stop_asked() || left() < 0.0; };
    try {
      return work(limited);
    } catch (const Interrupted&) {
      if (progress.stop_asked() || !(left() < 0.0)) throw;
      throw TimeLimitReached(message(*news));
    }
  }

 private:
  std::string message(const std::string& news) const;

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double stated_, seconds_, used_;
  std::string name_;
};

}  // namespace dwell

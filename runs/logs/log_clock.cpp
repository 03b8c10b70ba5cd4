#include "runs/logs/log_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

double median_period(const MotionLog& log) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < log.size(); ++i) {
    const double dt = log.seconds[i] - log.seconds[i - 1];
    if (dt > 0.0) periods.push_back(dt);
  }
  if (periods.empty())
    throw InputError(fmt::format("{}: the time never increases; increasing times are required", log.file));
  return upper_median(std::move(periods));
}

void drop_repeated(MotionLog& log) {
  std::size_t kept = 0, same = 0, other = 0;
  for (std::size_t i = 1; i < log.size(); ++i) {
    if (log.seconds[i] == log.seconds[kept]) {
      ++(log.places[i] == log.places[kept] ? same : other);
    } else {
      log.seconds[++kept] = log.seconds[i];
    }
    log.places[kept] = log.places[i];
  }
  if (10 * other > log.size()) {
    throw InputError(
        fmt::format("{}: {} of {} samples have the time of the one before, but another place: the clock is too coarse; "
                    "`log period` with x and y alone (`log columns`) is required",
                    log.file, other, log.size()));
  }
  log.seconds.resize(kept + 1);
  log.places.resize(kept + 1);
  if (same > 0) log.notes.push_back(fmt::format("{} repeated, left out", counted(same, "sample")));
  if (other > 0) {
    log.notes.push_back(
        fmt::format("{} with the time of another one, of which the last place counts", counted(other, "sample")));
  }
}

/// How far the tool runs in one period about sample i [mm], by the samples on both sides of the step to i.
double usual_way(const MotionLog& log, std::size_t i) {
  double way = 0.0, seconds = 0.0;
  const auto add = [&](std::size_t a) {
    const double dt = log.seconds[a + 1] - log.seconds[a];
    if (!(dt > 0.0) || dt > 1.5 * log.period) return;
    way += distance(log.places[a], log.places[a + 1]);
    seconds += dt;
  };
  if (i >= 2) add(i - 2);
  if (i + 1 < log.size()) add(i);
  return seconds > 0.0 ? way * log.period / seconds : 0.0;
}

bool clock_jumped(const MotionLog& log, std::size_t i) {
  const double dt = log.seconds[i] - log.seconds[i - 1];
  if (dt < 0.0) return true;
  if (!(dt > 3.0 * log.period)) return false;
  const double way = distance(log.places[i - 1], log.places[i]), usual = usual_way(log, i);
  return usual > 1e-4 && way > 0.5 * usual && way < 1.5 * usual;
}

}  // namespace

void settle_clock(MotionLog& log) {
  if (log.size() < 3) {
    throw InputError(fmt::format("{}: {}; at least 3 are required", log.file, counted(log.size(), "sample")));
  }
  drop_repeated(log);
  log.period = median_period(log);
  std::size_t jumps = 0, missing = 0;
  double first_jump = 0.0, jump_at = 0.0, gap_at = 0.0, shift = 0.0;
  std::vector<double> settled = log.seconds;
  for (std::size_t i = 1; i < log.size(); ++i) {
    const double dt = log.seconds[i] - log.seconds[i - 1];
    if (clock_jumped(log, i)) {
      if (jumps++ == 0) first_jump = dt - log.period, jump_at = log.seconds[i - 1];
      shift += log.period - dt;
    } else if (dt > 1.5 * log.period) {
      if (log.gaps.empty()) gap_at = log.seconds[i - 1];
      log.gaps.push_back(i - 1);
      missing += static_cast<std::size_t>(std::llround(dt / log.period)) - 1;
    }
    settled[i] = log.seconds[i] + shift;
  }
  if (100 * jumps > log.size()) {
    throw InputError(
        fmt::format("{}: the clock jumps {} times in {} samples, first by {:.4g} s at {:.6g} s; times that "
                    "increase from sample to sample are required",
                    log.file, jumps, log.size(), first_jump, jump_at));
  }
  log.seconds = std::move(settled);
  if (jumps > 0) {
    log.notes.push_back(fmt::format("{} of the clock taken out, the first by {:.4g} s at {:.6g} s",
                                    counted(jumps, "jump"), first_jump, jump_at));
  }
  if (!log.gaps.empty()) {
    log.notes.push_back(fmt::format("{} missing in {}, the first at {:.6g} s; the tool is taken to run straight there",
                                    counted(missing, "sample"), counted(log.gaps.size(), "place"), gap_at));
  }
}

}  // namespace dwell

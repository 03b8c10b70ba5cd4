#include "runs/logs/log_alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/feed/kinematic_path.h"
#include "runs/logs/path_tracker.h"

namespace dwell {
namespace {

constexpr std::size_t kStrays = 5;      // in a row that may lie beside the path
constexpr std::size_t kAttempts = 200;  // visits of the program's beginning that are tried

/// How far samples lie beside a smooth motion [mm]: from their second differences, which vanish at constant speed and
/// at rest, where a machine is for a quarter of the time at least.
double place_noise(const std::vector<Point>& places) {
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    bends.push_back(length(places[i - 1] - 2.0 * places[i] + places[i + 1]));
  if (bends.empty()) return 0.0;
  const auto quarter = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 4);
  std::nth_element(bends.begin(), quarter, bends.end());
  // Of normal noise of deviation s on both axes, a quarter of the lengths are below sqrt(6) * 0.7585 s.
  return *quarter / (2.449 * 0.7585);
}

struct Extent {
  std::size_t first, end;
};

Extent working_extent(const Program& program) {
  const auto removes = [](const ProgramStep& step) { return step.removes && step.length() > 0.0; };
  const auto begin = std::find_if(program.steps.begin(), program.steps.end(), removes);
  if (begin == program.steps.end())
    throw InputError(fmt::format("{}: no step removes anything; a log of its run cannot be laid on it", program.file));
  const auto last = std::find_if(program.steps.rbegin(), program.steps.rend(), removes);
  return {static_cast<std::size_t>(begin - program.steps.begin()),
          program.steps.size() - static_cast<std::size_t>(last - program.steps.rbegin())};
}

/// What became of an attempt to follow the path from one sample on.
struct Attempt {
  std::size_t begin = 0, end = 0;  // samples: the first, and behind the last that was followed
  std::vector<double> ways;        // along the path, of each
  double square_off = 0.0, max_off = 0.0;
  std::size_t working = 0;      // samples at work
  bool whole = false;           // it came to the end of the path
  double way = 0.0, off = 0.0;  // where it stopped, and how far from the path
  std::size_t step = 0;
};

class Aligner {
 public:
  Aligner(const std::vector<double>& seconds, const std::vector<Point>& places, const Program& program,
          double tolerance, double noise, const Progress& progress)
      : seconds_(seconds),
        places_(places),
        program_(program),
        extent_(working_extent(program)),
        tolerance_(tolerance),
        noise_(noise),
        progress_(progress) {
    for (const ProgramStep& step : program.steps) {
      if (step.seconds > 0.0) fastest_ = std::max(fastest_, step.length() / step.seconds);
    }
    fastest_ = std::max(fastest_, program.fastest_feed);
  }

  Extent extent() const { return extent_; }
  double noise() const { return noise_; }
  /// What counts as the same place along the path [mm].
  double same_place() const { return std::max(1e-3, 4.0 * noise_); }

  /// The attempt that came to the end, or the one that came farthest. Nothing if no sample comes near the beginning.
  std::optional<Attempt> best_attempt() const {
    const Point beginning = program_.steps[extent_.first].start;
    std::optional<Attempt> best;
    std::size_t attempts = 0;
    for (std::size_t i = 0; i < places_.size() && attempts < kAttempts; ++i) {
      if (!(distance(places_[i], beginning) <= tolerance_)) continue;
      // The last of a visit's samples that are as near as any.
      std::size_t nearest = i;
      double least = std::numeric_limits<double>::infinity();
      for (; i < places_.size() && distance(places_[i], beginning) <= tolerance_; ++i) {
        const double d = distance(places_[i], beginning);
        if (d < least + same_place()) nearest = i;
        least = std::min(least, d);
      }
      ++attempts;
      Attempt attempt = follow_from(nearest);
      if (!best || attempt.whole || attempt.way > best->way) best = std::move(attempt);
      if (best->whole) break;
    }
    return best;
  }

  double nearest_to_beginning() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Point place : places_) least = std::min(least, distance(place, program_.steps[extent_.first].start));
    return least;
  }

 private:
  Attempt follow_from(std::size_t begin) const {
    PathTracker tracker(program_.steps, extent_.first, extent_.end, 1e-6 + 4.0 * noise_);
    Attempt attempt;
    attempt.begin = attempt.end = begin;
    Poll poll(progress_);
    std::size_t strays = 0;
    const double period = seconds_.size() > 1 ? (seconds_.back() - seconds_.front()) / double(seconds_.size() - 1) : 0;
    for (std::size_t i = begin; i < places_.size(); ++i) {
      poll.step();
      double reach = 2.0 * tolerance_;
      if (i > begin) {
        reach += 1.5 * distance(places_[i - 1], places_[i]);
        // Where samples are missing the path may have turned in between.
        const double dt = seconds_[i] - seconds_[i - 1];
        if (dt > 1.5 * period) reach += fastest_ * dt;
      }
      tracker.follow(places_[i], reach, tolerance_);
      attempt.ways.push_back(tracker.way());
      attempt.end = i + 1;
      attempt.way = tracker.way();
      attempt.off = tracker.off();
      attempt.step = tracker.step();
      if (tracker.removes()) {
        strays = tracker.off() <= tolerance_ ? 0 : strays + 1;
        if (strays > kStrays) return attempt;
        attempt.square_off += tracker.off() * tracker.off();
        attempt.max_off = std::max(attempt.max_off, tracker.off());
        ++attempt.working;
      }
      if (tracker.total() - tracker.way() <= same_place()) {
        attempt.whole = true;
        return attempt;
      }
    }
    return attempt;
  }

  const std::vector<double>& seconds_;
  const std::vector<Point>& places_;
  const Program& program_;
  Extent extent_;
  double tolerance_, noise_, fastest_ = 0.0;
  const Progress& progress_;
};

/// What may have been done to the axes of a log.
struct AxisChange {
  const char* words;
  double xx, xy, yx, yy;
};
constexpr std::array<AxisChange, 12> kChanges{{{"x reversed", -1, 0, 0, 1},
                                               {"y reversed", 1, 0, 0, -1},
                                               {"x and y reversed", -1, 0, 0, -1},
                                               {"x and y exchanged", 0, 1, 1, 0},
                                               {"x and y exchanged and x then reversed", 0, -1, 1, 0},
                                               {"x and y exchanged and y then reversed", 0, 1, -1, 0},
                                               {"x and y exchanged and both reversed", 0, -1, -1, 0},
                                               {"places 1000 times as large", 1e3, 0, 0, 1e3},
                                               {"places 1000 times smaller", 1e-3, 0, 0, 1e-3},
                                               {"places 25.4 times as large (inch)", 25.4, 0, 0, 25.4},
                                               {"places 25.4 times smaller", 1 / 25.4, 0, 0, 1 / 25.4},
                                               {"places 1e6 times smaller", 1e-6, 0, 0, 1e-6}}};

/// "; with its x reversed it would fit", or nothing.
std::string what_would_fit(const MotionLog& log, const Program& program, double tolerance, const Progress& progress) {
  for (const AxisChange& change : kChanges) {
    std::vector<Point> places = log.places;
    for (Point& p : places) p = {change.xx * p.x + change.xy * p.y, change.yx * p.x + change.yy * p.y};
    const Aligner aligner(log.seconds, places, program, tolerance, place_noise(places), progress);
    const auto attempt = aligner.best_attempt();
    if (attempt && attempt->whole)
      return fmt::format(
          "; with {} it would fit: say its columns and units by `log columns`, or write it in the "
          "frame of the program",
          change.words);
  }
  return "";
}

[[noreturn]] void refuse(const MotionLog& log, const Program& program, double tolerance, const Aligner& aligner,
                         const std::optional<Attempt>& attempt, const Progress& progress) {
  const Point beginning = program.steps[aligner.extent().first].start;
  std::string what;
  if (!attempt) {
    what = fmt::format("it comes no nearer than {:.4g} mm to ({:.6g}, {:.6g}) mm, where the work of {} begins",
                       aligner.nearest_to_beginning(), beginning.x, beginning.y, program.file);
  } else if (attempt->off > tolerance) {
    what = fmt::format("it leaves the path of {} in step {} of {}: at {:.6g} s it is {:.4g} mm beside it", program.file,
                       attempt->step + 1, program.steps.size(), log.seconds[attempt->end - 1], attempt->off);
  } else {
    what = fmt::format("it ends in step {} of {} of {}, before the last that removes", attempt->step + 1,
                       program.steps.size(), program.file);
  }
  throw InputError(fmt::format("{}: no log of this path (`log tolerance` {:g} mm): {}{}", log.file, tolerance, what,
                               what_would_fit(log, program, tolerance, progress)));
}

std::vector<char> corners_of(const Program& program, Extent extent) {
  const std::vector<ProgramStep> steps(program.steps.begin() + static_cast<std::ptrdiff_t>(extent.first),
                                       program.steps.begin() + static_cast<std::ptrdiff_t>(extent.end));
  const KinematicPath path = kinematic_path(steps, Machine{});
  std::vector<char> corners;
  for (const double squared : path.corner) corners.push_back(static_cast<char>(squared == 0.0));
  return corners;
}

/// Nodes at one place, between which the program halts, share the pause there: each halt its time about the middle.
void share_halts(const Program& program, AlignedLog& aligned) {
  const std::size_t n = aligned.nodes.size();
  for (std::size_t k = 0; k + 1 < n;) {
    std::size_t last = k;
    double halt = 0.0;
    while (last + 1 < n && !(program.steps[aligned.first + last].length() > 0.0))
      halt += program.steps[aligned.first + last++].seconds;
    double at = aligned.nodes[k].passes - 0.5 * halt;
    for (std::size_t i = k; i <= last && last > k; ++i) {
      aligned.nodes[i].passes = at;
      if (i < last) at += program.steps[aligned.first + i].seconds;
    }
    k = last + 1;
  }
}

void find_times(const MotionLog& log, const Program& program, const Attempt& attempt, double same_place, double noise,
                AlignedLog& aligned) {
  std::vector<double> ways{0.0};
  for (std::size_t i = aligned.first; i < aligned.end; ++i) ways.push_back(ways.back() + program.steps[i].length());
  NodeTimes times({log.seconds.data() + attempt.begin, attempt.ways.size()}, attempt.ways, ways, {same_place, noise});
  for (std::size_t k = 0; k < ways.size(); ++k) aligned.nodes.push_back(times.next(aligned.corners[k] != 0));
  aligned.nodes.front().arrives = aligned.nodes.front().passes = aligned.nodes.front().leaves;
  aligned.nodes.back().leaves = aligned.nodes.back().passes = aligned.nodes.back().arrives;
}

void find_gaps(const MotionLog& log, AlignedLog& aligned) {
  aligned.gaps.assign(aligned.end - aligned.first, 0);
  std::size_t k = 0;
  for (const std::size_t sample : log.gaps) {
    const double from = log.seconds[sample], to = log.seconds[sample + 1];
    while (k < aligned.gaps.size() && aligned.nodes[k + 1].leaves < from) ++k;
    for (std::size_t i = k; i < aligned.gaps.size() && aligned.nodes[i].arrives <= to; ++i) aligned.gaps[i] = 1;
  }
}

void check_tolerance(double tolerance) {
  if (!(std::isfinite(tolerance) && tolerance > 0.0))
    throw InputError("log tolerance", fmt::format("{} mm", tolerance), "a finite number > 0");
}

}  // namespace

AlignedLog align_log(const MotionLog& log, const Program& program, double tolerance, const Progress& progress) {
  check_tolerance(tolerance);
  const Aligner aligner(log.seconds, log.places, program, tolerance, place_noise(log.places), progress);
  const std::optional<Attempt> attempt = aligner.best_attempt();
  if (!attempt || !attempt->whole) refuse(log, program, tolerance, aligner, attempt, progress);
  AlignedLog aligned;
  aligned.first = aligner.extent().first;
  aligned.end = aligner.extent().end;
  aligned.tolerance = tolerance;
  aligned.before = attempt->begin;
  aligned.within = attempt->end - attempt->begin;
  aligned.after = log.size() - attempt->end;
  aligned.rms_off = std::sqrt(attempt->square_off / static_cast<double>(std::max<std::size_t>(1, attempt->working)));
  aligned.max_off = attempt->max_off;
  aligned.corners = corners_of(program, aligner.extent());
  find_times(log, program, *attempt, aligner.same_place(), aligner.noise(), aligned);
  share_halts(program, aligned);
  find_gaps(log, aligned);
  return aligned;
}

LogEnd end_of_log(const MotionLog& log, const Program& program, double tolerance, const Progress& progress) {
  constexpr double kRest = 0.2;  // [s]
  check_tolerance(tolerance);
  const Aligner aligner(log.seconds, log.places, program, tolerance, place_noise(log.places), progress);
  const std::optional<Attempt> attempt = aligner.best_attempt();
  if (!attempt) refuse(log, program, tolerance, aligner, attempt, progress);
  if (attempt->whole) {
    throw InputError(
        fmt::format("{}: it has run {} to the end of its work: nothing is left to be done", log.file, program.file));
  }
  std::size_t last = attempt->end - 1;  // sample
  if (attempt->off > tolerance) {
    // It leaves the path: where it was stopped, if it rested there before.
    last -= std::min(last - attempt->begin, kStrays + 1);
    const auto rested = [&](std::size_t i) {
      std::size_t before = i;
      while (before > attempt->begin && log.seconds[i] - log.seconds[before] < kRest) --before;
      return log.seconds[i] - log.seconds[before] >= kRest &&
             distance(log.places[i], log.places[before]) <= aligner.same_place();
    };
    const Point leaves = log.places[last];
    while (last > attempt->begin && !rested(last) && distance(log.places[last], leaves) <= 2.0 * tolerance) --last;
    if (!rested(last)) refuse(log, program, tolerance, aligner, attempt, progress);
  }
  const double way = attempt->ways[last - attempt->begin];
  LogEnd end;
  double left = way;
  end.step = aligner.extent().first;
  while (end.step + 1 < aligner.extent().end && left >= program.steps[end.step].length())
    left -= program.steps[end.step++].length();
  const ProgramStep& step = program.steps[end.step];
  end.share = step.length() > 0.0 ? std::clamp(left / step.length(), 0.0, 1.0) : 0.0;
  end.place = step.start + end.share * (step.finish - step.start);
  return end;
}

Program recorded_motion(const MotionLog& log, const AlignedLog& aligned, const Program& program) {
  Program motion;
  motion.file = program.file;
  std::size_t sample = 0;
  for (std::size_t i = aligned.first; i < aligned.end;) {
    if (!program.steps[i].removes) {
      ++i;
      continue;
    }
    if (!motion.steps.empty()) motion.steps.push_back({motion.steps.back().finish, program.steps[i].start, 0.0, false});
    std::size_t end = i;
    while (end < aligned.end && program.steps[end].removes) ++end;
    const double from = aligned.nodes[i - aligned.first].leaves, to = aligned.nodes[end - aligned.first].arrives;
    while (sample + 1 < log.size() && log.seconds[sample + 1] <= from) ++sample;
    for (; sample + 1 < log.size() && log.seconds[sample] < to; ++sample) {
      const double t0 = log.seconds[sample], t1 = log.seconds[sample + 1];
      const auto place_at = [&](double t) {
        return log.places[sample] + ((t - t0) / (t1 - t0)) * (log.places[sample + 1] - log.places[sample]);
      };
      const double begin = std::max(from, t0), finish = std::min(to, t1);
      if (finish > begin) motion.steps.push_back({place_at(begin), place_at(finish), finish - begin, true});
      if (t1 > to) break;
    }
    i = end;
  }
  return motion;
}

}  // namespace dwell

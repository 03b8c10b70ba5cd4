#include "paths/feed/linear_schedule.h"

#include <algorithm>
#include <cmath>

#include "core/base/side_by_side.h"
#include "paths/feed/least_dwell.h"
#include "paths/feed/natural_speeds.h"
#include "paths/feed/speed_minimiser.h"

namespace dwell {
namespace {

constexpr std::size_t kBesideWindow = 6;      // strokes on each side of those that break a limit
constexpr double kCalm = 0.5;                 // of its reach, as much as a window's outermost pieces use
constexpr std::size_t kStrokesATask = 20000;  // of windows that one thread does in a row

class Windows {
 public:
  Windows(const SpeedNodes& nodes, const std::vector<StrokePieces>& strokes, const NaturalSpeeds& natural)
      : nodes_(nodes), strokes_(strokes), natural_(natural) {}

  /// Around every stroke that does not hold its dwell, in order, apart from each other.
  std::vector<SpeedWindow> find() const {
    std::vector<SpeedWindow> windows;
    for (std::size_t j = 0; j < strokes_.size(); ++j) {
      if (natural_.holds[j] != 0 || (!windows.empty() && strokes_[j].last <= windows.back().last)) continue;
      SpeedWindow window{begin_of(j), end_of(j)};
      if (!windows.empty() && window.first < windows.back().last) {
        windows.back().last = window.last;
      } else {
        windows.push_back(window);
      }
    }
    return windows;
  }

 private:
  bool rests_at(std::size_t node) const { return nodes_.cap[node] == 0.0; }
  bool is_calm(std::size_t piece) const {
    const double change = std::abs(natural_.u[piece + 1] - natural_.u[piece]);
    return !(change > kCalm * nodes_.pieces[piece].reach);
  }

  std::size_t begin_of(std::size_t j) const {
    std::size_t k = j;
    while (!rests_at(strokes_[k].first) &&
           (k + kBesideWindow > j || natural_.holds[k] == 0 || !is_calm(strokes_[k].first)))
      --k;
    return strokes_[k].first;
  }

  std::size_t end_of(std::size_t j) const {
    std::size_t k = j, last_broken = j;
    while (!rests_at(strokes_[k].last) && (k < last_broken + kBesideWindow || !is_calm(strokes_[k].last - 1))) {
      ++k;
      if (natural_.holds[k] == 0) last_broken = k;
    }
    return strokes_[k].last;
  }

  const SpeedNodes& nodes_;
  const std::vector<StrokePieces>& strokes_;
  const NaturalSpeeds& natural_;
};

/// Windows [from, to) of a list, for one thread.
struct Task {
  std::size_t from, to;
};

std::vector<Task> tasks_of(const std::vector<SpeedWindow>& windows) {
  std::vector<Task> tasks;
  std::size_t nodes = 0;
  for (std::size_t k = 0; k < windows.size(); ++k) {
    if (tasks.empty() || nodes > 2 * kStrokesATask) {
      tasks.push_back({k, k});
      nodes = 0;
    }
    tasks.back().to = k + 1;
    nodes += windows[k].last - windows[k].first;
  }
  return tasks;
}

/// Solves all windows in place. Returns the most steps of one.
int solve_windows(const SpeedNodes& nodes, const std::vector<SpeedWindow>& windows, const Eigen::VectorXd& moving,
                  std::vector<double>& u, int threads, const Progress& progress) {
  const double mean = std::max(moving.size() > 0 ? moving.mean() : 0.0, 1e-300);
  const std::vector<Task> tasks = tasks_of(windows);
  std::vector<int> steps(tasks.size(), 0);
  run_side_by_side(threads, progress, tasks.size(), [&](std::size_t k, const Progress& shared) {
    SpeedMinimiser minimiser(nodes, moving, mean);
    for (std::size_t w = tasks[k].from; w < tasks[k].to; ++w)
      steps[k] = std::max(steps[k], minimiser.minimise(windows[w], u, shared));
  });
  return steps.empty() ? 0 : *std::max_element(steps.begin(), steps.end());
}

/// The dwell less the rests at exact stops; 0 for halts, which are no matter of speed.
Eigen::VectorXd moving_time(const std::vector<StrokePieces>& strokes, const Eigen::VectorXd& dwell,
                            const Eigen::VectorXd& delays) {
  Eigen::VectorXd moving = (dwell - delays).cwiseMax(0.0);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (!(strokes[j].length > 0.0)) moving[static_cast<Index>(j)] = 0.0;
  }
  return moving;
}

}  // namespace

LinearSchedule schedule_linear(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                               const Eigen::VectorXd& dwell, int threads, const Progress& progress) {
  const Eigen::VectorXd delays = rests_of_strokes(moves, path, machine);
  const SpeedNodes nodes = speed_nodes(moves, path);
  const std::vector<StrokePieces> strokes = pieces_of_strokes(nodes, moves.strokes);
  const Eigen::VectorXd moving = moving_time(strokes, dwell, delays);
  NaturalSpeeds natural = natural_speeds(nodes, strokes, moving);
  const std::vector<SpeedWindow> windows = Windows(nodes, strokes, natural).find();
  LinearSchedule result;
  result.windows = static_cast<Index>(windows.size());
  result.steps = solve_windows(nodes, windows, moving, natural.u, threads, progress);
  result.seconds = dwell;
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (!(strokes[j].length > 0.0)) continue;
    double seconds = 0.0;
    for (std::size_t i = strokes[j].first; i < strokes[j].last; ++i)
      seconds += time_between(nodes.pieces[i], natural.u[i], natural.u[i + 1]);
    const auto k = static_cast<Index>(j);
    result.seconds[k] = seconds + delays[k];
    result.worst_error = std::max(result.worst_error, std::abs(seconds - moving[k]) / std::max(moving[k], 1e-300));
  }
  result.speed.reserve(natural.u.size());
  for (const double u : natural.u) result.speed.push_back(std::sqrt(u));
  return result;
}

}  // namespace dwell

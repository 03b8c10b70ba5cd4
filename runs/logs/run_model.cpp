#include "runs/logs/run_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "paths/feed/step_times.h"
#include "solvers/fits/ceres_nonlinear_fit.h"

namespace dwell {
namespace {

constexpr double kMillisecond = 1e-3;  // residuals are in ms

double squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

LoggedMachine with_values(LoggedMachine machine, const std::vector<FitFigure>& figures,
                          std::span<const double> numbers) {
  for (std::size_t k = 0; k < figures.size(); ++k) record_of(figures[k]).of(machine) = from_fit(figures[k], numbers[k]);
  return machine;
}

bool is_acceleration(FitFigure figure) {
  return figure == FitFigure::PathAcceleration || figure == FitFigure::XAcceleration ||
         figure == FitFigure::YAcceleration;
}

}  // namespace

double RunFit::error_of(FitFigure figure) const {
  const auto at = std::find(figures.begin(), figures.end(), figure);
  return at == figures.end() ? std::numeric_limits<double>::quiet_NaN()
                             : errors[static_cast<std::size_t>(at - figures.begin())];
}

bool RunFit::has(FitFigure figure) const { return std::find(figures.begin(), figures.end(), figure) != figures.end(); }

RunModel::RunModel(const Program& program, std::vector<LoggedRun> runs, const Progress& progress)
    : program_(program), runs_(std::move(runs)), progress_(progress) {}

std::vector<double> RunModel::differences(const LoggedMachine& machine) const {
  const std::vector<double> steps = step_times(program_, machine.machine);
  std::vector<double> differences;
  differences.reserve(runs_.size());
  for (const LoggedRun& run : runs_) {
    differences.push_back(run.seconds - machine.clock * (run_seconds(run, steps) +
                                                         machine.block_delay * static_cast<double>(run.steps())));
  }
  return differences;
}

double RunModel::square_sum(const LoggedMachine& machine) const { return squares(differences(machine)); }

RunFit RunModel::fit(const LoggedMachine& start, const std::vector<FitFigure>& figures) const {
  std::vector<FitStart> starts;
  LoggedMachine at = start;  // of() gives a place to write to
  for (const FitFigure figure : figures) {
    const FigureRecord& record = record_of(figure);
    starts.push_back({to_fit(figure, record.of(at)), to_fit(figure, record.least), to_fit(figure, record.most)});
  }
  const FitResiduals residuals = [&](std::span<const double> numbers, std::span<double> out) {
    progress_.check();
    const std::vector<double> found = differences(with_values(start, figures, numbers));
    for (std::size_t i = 0; i < found.size(); ++i) out[i] = found[i] / kMillisecond;
    return std::all_of(out.begin(), out.end(), [](double v) { return std::isfinite(v); });
  };
  const NonlinearFit found = fit_least_squares(residuals, runs_.size(), starts, progress_);
  RunFit result{with_values(start, figures, found.values), figures, {}, found.square_sum * kMillisecond * kMillisecond};
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const double value = record_of(figures[k]).of(result.machine);
    result.errors.push_back(error_from_fit(figures[k], value, found.errors[k]));
  }
  return result;
}

RunFit RunModel::fit_from_scratch(LoggedMachine start, const std::vector<FitFigure>& figures) const {
  const auto has = [&figures](FitFigure figure) {
    return std::find(figures.begin(), figures.end(), figure) != figures.end();
  };
  const std::vector<double> deviations =
      has(FitFigure::JunctionDeviation) ? std::vector<double>{1e-4, 1e-3, 1e-2, 1e-1} : std::vector<double>{0.0};
  LoggedMachine best = start;
  double least = std::numeric_limits<double>::infinity();
  for (const double deviation : deviations) {
    for (double magnitude = 0.0; magnitude <= 5.0; magnitude += 0.25) {
      LoggedMachine trial = start;
      for (const FitFigure figure : figures) {
        if (is_acceleration(figure)) record_of(figure).of(trial) = std::pow(10.0, magnitude);
        if (figure == FitFigure::JunctionDeviation) record_of(figure).of(trial) = deviation;
        if (figure == FitFigure::CornerDelay) record_of(figure).of(trial) = 0.0;
      }
      std::vector<double> left = differences(trial);
      if (has(FitFigure::CornerDelay)) {
        const double mean = std::accumulate(left.begin(), left.end(), 0.0) / static_cast<double>(left.size());
        trial.machine.corner_delay = std::max(0.0, mean);
        for (double& v : left) v -= trial.machine.corner_delay;
      }
      const double sum = squares(left);
      if (sum < least) least = sum, best = trial;
    }
  }
  return fit(best, figures);
}

double RunModel::criterion(const RunFit& fit) const {
  const double n = static_cast<double>(runs_.size());
  constexpr double kFinest = 1e-6;  // what no log tells of a time [s]
  return n * std::log(fit.square_sum / n + kFinest * kFinest) + std::log(n) * static_cast<double>(fit.figures.size());
}

}  // namespace dwell

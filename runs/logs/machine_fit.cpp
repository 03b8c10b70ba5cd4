#include "runs/logs/machine_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"
#include "paths/feed/step_times.h"
#include "runs/logs/run_model.h"

namespace dwell {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kBetter = 10.0;        // by which the criterion falls for what is to enter
constexpr double kUncertain = 0.3;      // relative standard error of a figure that counts as not determined
constexpr double kOutlier = 6.0;        // robust standard deviations, when all figures are known
constexpr double kFarOut = 30.0;        // and before
constexpr double kMostOutliers = 0.05;  // of the runs
// By which a clock must be off to count: overrides are off by a per cent and more, and what a controller does besides
// the model may look like a part in a thousand.
constexpr double kLeastClock = 5e-3;

double root_mean_square(double square_sum, std::size_t count) {
  return std::sqrt(square_sum / static_cast<double>(std::max<std::size_t>(1, count)));
}

/// The feeds that the runs command [mm/s]: the highest.
double highest_feed(const Program& program, const std::vector<LoggedRun>& runs) {
  double highest = 0.0;
  for (const LoggedRun& run : runs) {
    for (std::size_t i = run.first; i < run.end; ++i)
      highest = std::max(highest, program.steps[i].length() / program.steps[i].seconds);
  }
  return highest;
}

class MachineFitter {
 public:
  MachineFitter(const AlignedLog& aligned, const Program& program, const Machine& start, const Progress& progress)
      : program_(program), start_(start), progress_(progress), model_(program, {}, progress) {
    LoggedRuns found = logged_runs(aligned, program);
    if (found.runs.size() < kLeastRuns) {
      throw InputError(
          fmt::format("{}: {} from corner to corner can be fitted ({} left out for missing samples, {} for lifts and "
                      "halts); at least {} are required",
                      program.file, counted(found.runs.size(), "run"), found.gaps, found.lifted, kLeastRuns));
    }
    result_.gaps = found.gaps;
    result_.lifted = found.lifted;
    model_.keep(std::move(found.runs));
    rule_is_said_ = std::any_of(program.path_modes.begin(), program.path_modes.end(),
                                [&](const auto& change) { return change.first_step <= aligned.first; });
  }

  MachineFit run() {
    unlimited_.machine = start_;
    unlimited_.machine.max_feed = unlimited_.machine.path_acceleration = kNone;
    for (MachineAxis* axis : {&unlimited_.machine.x, &unlimited_.machine.y})
      axis->max_speed = axis->max_acceleration = kNone;
    unlimited_.machine.corner_delay = 0.0;
    progress_.step("corner rule");
    RunFit fit = best_rule();
    leave_out_outliers(fit, kFarOut);  // lone ones so large that they hide all else
    progress_.step("speed limit");
    fit = with_speed_limit(std::move(fit));
    progress_.step("axes");
    fit = with_axes(std::move(fit));
    leave_out_outliers(fit, kOutlier);
    fit = without_uncertain(std::move(fit));
    progress_.step("clock and blocks");
    fit = with_clock(std::move(fit));
    report(fit);
    report_block_delay(fit);
    return std::move(result_);
  }

 private:
  std::vector<FitFigure> figures_of(CornerRule rule) const {
    std::vector<FitFigure> figures{FitFigure::PathAcceleration};
    if (rule == CornerRule::ExactStop || rule_is_said_) figures.push_back(FitFigure::CornerDelay);
    if (rule == CornerRule::JunctionDeviation && !rule_is_said_) figures.push_back(FitFigure::JunctionDeviation);
    return figures;
  }

  RunFit fit_of_rule(CornerRule rule) const {
    LoggedMachine machine = unlimited_;
    machine.machine.corner = rule;
    return model_.fit_from_scratch(machine, figures_of(rule));
  }

  /// The rule that explains the log best; the one of the start unless another does so clearly.
  RunFit best_rule() {
    RunFit best = fit_of_rule(start_.corner);
    if (rule_is_said_) {
      result_.undetermined.push_back({"corner rule", "the program says its path mode, which comes before it"});
      return best;
    }
    const double of_start = model_.criterion(best);
    double nearest = kNone;
    for (const CornerRule rule : {CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free}) {
      if (rule == start_.corner) continue;
      RunFit other = fit_of_rule(rule);
      const double gain = of_start - model_.criterion(other);
      nearest = std::min(nearest, -gain);
      if (gain > kBetter && model_.criterion(other) < model_.criterion(best)) best = std::move(other);
    }
    if (best.machine.machine.corner != start_.corner || nearest > kBetter) {
      result_.notes.push_back(fmt::format("corner rule {}: fits the log best", to_string(best.machine.machine.corner)));
    } else {
      result_.undetermined.push_back({"corner rule", "others fit the log as well"});
    }
    return best;
  }

  void leave_out_outliers(RunFit& fit, double deviations) {
    const std::vector<double> left = model_.differences(fit.machine);
    std::vector<double> sizes;
    sizes.reserve(left.size());
    const double middle = upper_median(left);
    for (const double v : left) sizes.push_back(std::abs(v - middle));
    const double limit = deviations * kSigmaPerMedianDeviation * upper_median(sizes);
    std::vector<LoggedRun> kept;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (std::abs(left[i] - middle) <= limit) kept.push_back(model_.runs()[i]);
    }
    const std::size_t out = left.size() - kept.size();
    if (out == 0 || !(limit > 0.0) || kept.size() < kLeastRuns ||
        static_cast<double>(out) > kMostOutliers * static_cast<double>(left.size())) {
      return;
    }
    result_.outliers += out;
    model_.keep(std::move(kept));
    fit = model_.fit(fit.machine, fit.figures);
  }

  bool is_certain(const RunFit& fit, FitFigure figure) const {
    RunFit copy = fit;
    const double value = record_of(figure).of(copy.machine);
    return fit.error_of(figure) < kUncertain * value;  // not where the error is NaN
  }

  /// Tries limits below the highest feed that is commanded; the fit goes on from the best of them.
  RunFit with_speed_limit(RunFit fit) {
    const double highest = highest_feed(program_, model_.runs());
    LoggedMachine best = fit.machine;
    double least = fit.square_sum;
    for (double limit = 0.98 * highest; limit > 0.02 * highest; limit *= 0.8) {
      LoggedMachine trial = fit.machine;
      trial.machine.max_feed = limit;
      const double sum = model_.square_sum(trial);
      if (sum < least) least = sum, best = trial;
    }
    if (std::isfinite(best.machine.max_feed)) {
      std::vector<FitFigure> figures = fit.figures;
      figures.push_back(FitFigure::MaxFeed);
      RunFit limited = model_.fit(best, figures);
      if (model_.criterion(limited) < model_.criterion(fit) - kBetter && is_certain(limited, FitFigure::MaxFeed))
        return limited;
    }
    result_.undetermined.push_back(
        {record_of(FitFigure::MaxFeed).name,
         fmt::format("not reached: every feed of the runs, up to {:.4g} mm/s, was kept", highest)});
    return fit;
  }

  /// Accelerations of the axes in the place of one along the path, if they explain the log better.
  RunFit with_axes(RunFit fit) {
    std::vector<FitFigure> figures{FitFigure::XAcceleration, FitFigure::YAcceleration};
    std::copy_if(fit.figures.begin(), fit.figures.end(), std::back_inserter(figures),
                 [](FitFigure figure) { return figure != FitFigure::PathAcceleration; });
    LoggedMachine machine = fit.machine;
    machine.machine.x.max_acceleration = machine.machine.y.max_acceleration =
        std::exchange(machine.machine.path_acceleration, kNone);
    RunFit axes = model_.fit(machine, figures);
    const bool certain = is_certain(axes, FitFigure::XAcceleration) && is_certain(axes, FitFigure::YAcceleration);
    if (certain && model_.criterion(axes) < model_.criterion(fit) - kBetter) return axes;
    result_.undetermined.push_back({"acceleration of each axis", "one along the path explains the log as well"});
    return fit;
  }

  /// Figures that the log does not determine go back to those of the start, and the others are fitted again. Where the
  /// log contradicts the start they are left out.
  RunFit without_uncertain(RunFit fit) {
    std::vector<FitFigure> kept;
    LoggedMachine of_start = fit.machine, freed = fit.machine, start{start_};
    for (const FitFigure figure : fit.figures) {
      const FigureRecord& record = record_of(figure);
      if (record.logarithmic ? is_certain(fit, figure) : std::isfinite(fit.error_of(figure))) {
        kept.push_back(figure);
        continue;
      }
      record.of(of_start) = record.of(start);
      if (std::isinf(record.none) && figure != FitFigure::JunctionDeviation) record.of(freed) = record.none;
      if (figure == FitFigure::PathAcceleration) {
        of_start.machine.x.max_acceleration = start_.x.max_acceleration;
        of_start.machine.y.max_acceleration = start_.y.max_acceleration;
      }
      result_.undetermined.push_back({record.name, "it hardly changes the times of the runs"});
    }
    if (kept.size() == fit.figures.size()) return fit;
    RunFit held = model_.fit(of_start, kept), without = model_.fit(freed, kept);
    if (!(model_.criterion(held) > model_.criterion(without) + kBetter)) return held;
    result_.notes.emplace_back(
        "the acceleration of the machine that the fit began with is left out: the log shows a higher "
        "one, too high to be told from its times");
    start_.path_acceleration = start_.x.max_acceleration = start_.y.max_acceleration = kNone;
    return without;
  }

  RunFit with_clock(RunFit fit) {
    std::vector<FitFigure> figures = fit.figures;
    figures.push_back(FitFigure::Clock);
    RunFit clocked = model_.fit(fit.machine, figures);
    const double error = clocked.error_of(FitFigure::Clock), off = std::abs(clocked.machine.clock - 1.0);
    if (!(error < 0.01)) {
      result_.undetermined.push_back(
          {record_of(FitFigure::Clock).name, "the runs have too little way at a constant feed"});
      return fit;
    }
    if (off > kLeastClock && off > 5.0 * error && model_.criterion(clocked) < model_.criterion(fit) - kBetter) {
      result_.notes.push_back(fmt::format(
          "the times of the log are {:.6g} times those of the feeds: a clock that is off, or a feed override that was "
          "not at 100 %; taken out of what is written",
          clocked.machine.clock));
      return clocked;
    }
    result_.fitted.push_back(figure_of(clocked, FitFigure::Clock, fit.square_sum, clocked.square_sum));
    return fit;
  }

  FittedFigure figure_of(const RunFit& fit, FitFigure figure, double without, double with) const {
    RunFit copy = fit;
    const FigureRecord& record = record_of(figure);
    return {record.name,          record.key,
            record.unit,          record.of(copy.machine),
            fit.error_of(figure), std::max(0.0, without - with) / model_.square_sum(unlimited_),
            record.written};
  }

  /// The square sums of fits with the first k of a fit's figures, k = 0, 1, ..., all.
  std::vector<double> square_sums_by_figure(const RunFit& fit) const {
    std::vector<double> sums;
    for (std::size_t k = 0; k <= fit.figures.size(); ++k) {
      LoggedMachine machine = fit.machine;
      for (std::size_t i = k; i < fit.figures.size(); ++i) {
        record_of(fit.figures[i]).of(machine) = record_of(fit.figures[i]).none;
        if (fit.figures[i] == FitFigure::JunctionDeviation) machine.machine.corner = CornerRule::ExactStop;
      }
      const auto end = fit.figures.begin() + static_cast<std::ptrdiff_t>(k);
      sums.push_back(k == fit.figures.size() ? fit.square_sum
                                             : model_.fit(machine, {fit.figures.begin(), end}).square_sum);
    }
    return sums;
  }

  void report(const RunFit& fit) {
    const std::vector<LoggedRun>& runs = model_.runs();
    result_.machine = start_;
    LoggedMachine written{start_};
    LoggedMachine found = fit.machine;
    written.machine.corner = rule_is_said_ ? start_.corner : found.machine.corner;
    std::vector<FittedFigure> figures;
    const std::vector<double> sums = square_sums_by_figure(fit);
    for (std::size_t k = 0; k < fit.figures.size(); ++k) {
      const FitFigure figure = fit.figures[k];
      figures.push_back(figure_of(fit, figure, sums[k], sums[k + 1]));
      if (record_of(figure).written) record_of(figure).of(written) = record_of(figure).of(found);
    }
    result_.fitted.insert(result_.fitted.begin(), figures.begin(), figures.end());
    if (fit.has(FitFigure::PathAcceleration))
      written.machine.x.max_acceleration = written.machine.y.max_acceleration = kNone;
    if (fit.has(FitFigure::XAcceleration)) written.machine.path_acceleration = kNone;
    if (!fit.has(FitFigure::MaxFeed)) keep_speeds_of_start(written.machine, found.clock);
    result_.machine = written.machine;
    result_.undetermined.push_back({"following lag", "places alone do not show it: they are all late by it alike"});
    result_.runs = runs.size();
    result_.commanded_rms = root_mean_square(model_.square_sum(unlimited_), runs.size());
    result_.rms = root_mean_square(fit.square_sum, runs.size());
    const std::vector<double> steps = step_times(program_, fit.machine.machine);
    const std::vector<double> commanded = step_times(program_, unlimited_.machine);
    for (const LoggedRun& run : runs) {
      result_.logged += run.seconds;
      result_.modelled += fit.machine.clock * run_seconds(run, steps);
      result_.commanded += run_seconds(run, commanded);
    }
  }

  /// Speed limits of the start stay, but for those that the log has passed.
  void keep_speeds_of_start(Machine& machine, double clock) {
    const double highest = highest_feed(program_, model_.runs());
    LoggedMachine limited{machine, clock};
    LoggedMachine freed{machine, clock};
    freed.machine.max_feed = freed.machine.x.max_speed = freed.machine.y.max_speed = kNone;
    const double with = model_.square_sum(limited), without = model_.square_sum(freed);
    if (!(with > without * (1.0 + kBetter / static_cast<double>(model_.runs().size())))) return;
    machine = freed.machine;
    result_.notes.push_back(
        fmt::format("the speed limits of the machine that the fit began with are left out: the log shows feeds up to "
                    "{:.4g} mm/s that they forbid",
                    highest));
  }

  void report_block_delay(const RunFit& fit) {
    std::vector<FitFigure> figures = fit.figures;
    figures.push_back(FitFigure::BlockDelay);
    const RunFit blocks = model_.fit(fit.machine, figures);
    const double error = blocks.error_of(FitFigure::BlockDelay);
    if (!std::isfinite(error)) {
      result_.undetermined.push_back(
          {record_of(FitFigure::BlockDelay).name, "every run has as many blocks as another"});
      return;
    }
    result_.fitted.push_back(figure_of(blocks, FitFigure::BlockDelay, fit.square_sum, blocks.square_sum));
    LoggedMachine found = blocks.machine;
    if (found.block_delay > 0.0 && model_.criterion(blocks) < model_.criterion(fit) - kBetter) {
      result_.notes.push_back(fmt::format(
          "a delay of {:.4g} ms a block would explain more; machine files have none, and the other figures are fitted "
          "without it (with it the delay at a corner is {:.4g} ms)",
          1e3 * found.block_delay, 1e3 * found.machine.corner_delay));
    }
  }

  const Program& program_;
  Machine start_;
  const Progress& progress_;
  RunModel model_;
  LoggedMachine unlimited_;  // takes the commanded times
  bool rule_is_said_ = false;
  MachineFit result_;
};

/// "acceleration along the path 47.2 +- 0.1 mm/s^2, explains 91 %".
std::string comment_of(const FittedFigure& figure) {
  return fmt::format("# {}: {:.6g} with a standard error of {:.2g}{}{}, explains {:.3g} %{}\n", figure.name,
                     figure.value, figure.error, figure.unit.empty() ? "" : " ", figure.unit, 100.0 * figure.explained,
                     figure.written ? "" : "; not in this file");
}

/// A name of a file as a comment may hold it.
std::string in_comment(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace

MachineFit fit_machine(const AlignedLog& aligned, const Program& program, const Machine& start,
                       const Progress& progress) {
  if (std::any_of(program.steps.begin(), program.steps.end(),
                  [](const auto& step) { return step.speeds.has_value(); })) {
    throw InputError(
        fmt::format("{}: says the speeds at the ends of its moves, which a machine runs as they stand; a program of "
                    "feeds is required to learn a machine from its log",
                    program.file));
  }
  return MachineFitter(aligned, program, start, progress).run();
}

std::string fitted_machine_text(const MachineFit& fit, const std::string& name, const std::string& log) {
  std::string text = machine_text({name, fit.machine});
  text += fmt::format("\n# Fitted to {} of the log {}:\n", counted(fit.runs, "run"), in_comment(log));
  for (const FittedFigure& figure : fit.fitted) text += comment_of(figure);
  for (const UndeterminedFigure& figure : fit.undetermined)
    text += fmt::format("# not determined: {} ({})\n", figure.name, figure.why);
  for (const std::string& note : fit.notes) text += fmt::format("# {}\n", note);
  return text;
}

}  // namespace dwell

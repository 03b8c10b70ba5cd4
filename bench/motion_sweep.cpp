#include "bench/motion_sweep.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/removal/simulate.h"
#include "core/tif/models/removal_models.h"
#include "paths/feed/execution.h"
#include "runs/drawing/line_chart.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_program.h"

namespace dwell::bench {
namespace {

struct SweptPath {
  const char* name;
  const char* spec;
  double smoothness;
  Colour colour;
};

// The radius of the tool is 6 mm: the first path turns where it no longer reaches the part, the others within reach.
constexpr std::array<SweptPath, 4> kPaths{
    {{"raster, turns beyond the part", "raster:pitch=1,overrun=6", 0.1, {0, 114, 178}},
     {"the same, rough", "raster:pitch=1,overrun=6", 1e-3, {86, 180, 233}},
     {"raster, turns at the edge", "raster:pitch=1,overrun=1", 0.1, {0, 158, 115}},
     {"random, a turn every 2 mm", "random:pitch=1,overrun=6,seed=3", 0.1, {213, 94, 0}}}};
constexpr std::array kAccelerations{2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0};

/// In waves that the tool reaches: what no tool removes would hide what the motion loses.
Part made_up_part(int threads) {
  HeightMap map(Grid{73, 97, 0.25, 0.25, {-12.0, -9.0}});
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      const double x = map.grid.x(c), y = map.grid.y(r);
      map.at(r, c) = 30.0 * std::sin(kTurn * x / 13.0 + 0.4) * std::cos(kTurn * y / 11.0) +
                     15.0 * std::sin(kTurn * (x + 0.7 * y) / 8.0) + 0.1 * x * y;
    }
  }
  return make_part(std::move(map), gaussian_removal(8.0, 4.0, 6.0), {true, true}, threads);
}

Machine machine_of(double acceleration) {
  Machine machine;
  machine.max_feed = 50.0;
  machine.path_acceleration = acceleration;
  return machine;
}

double left_by(const Part& part, const Program& motion, const RemovalKernel& kernel) {
  const HeightMap left = surface_after(part.map, simulate(motion, part.map, kernel, part.threads));
  return map_statistics(left, part.form, part.threads).rms_about_zero();
}

}  // namespace

std::vector<MotionLoss> sweep_motion(int threads, const Progress& progress) {
  const Part part = made_up_part(threads);
  std::vector<MotionLoss> losses;
  for (const SweptPath& path : kPaths) {
    DwellOptions options;
    options.smoothness = {path.smoothness};
    const LaidPath laid =
        lay_path(part, parse_path_spec(path.spec), Motion::Moving, options.machine.feed_limits().max_feed, progress);
    const DwellPlan unaware = find_dwell(part, laid, options, progress);
    options.time_price = {unaware.weights.time_price};  // the same trade for every machine
    const Program feeds = program_of(make_machine_program(laid, unaware, options.machine, progress).table);
    for (const double acceleration : kAccelerations) {
      progress.report(fmt::format("{}: {:g} mm/s^2", path.name, acceleration));
      MotionLoss loss{path.name, acceleration, unaware.residual.rms_about_zero(), feeds.total_seconds()};
      const Machine machine = machine_of(acceleration);
      const Program run = execute(feeds, machine, progress).motion;
      loss.unaware = left_by(part, run, unaware.lattice.kernel);
      loss.unaware_seconds = run.total_seconds();
      DwellOptions known = options;
      known.machine.machine = machine;
      const DwellPlan aware = find_dwell(part, laid, known, progress);
      const Program own = program_of(make_machine_program(laid, aware, known.machine, progress).table);
      const Program own_run = execute(own, machine, progress).motion;
      loss.bounded = aware.residual.rms_about_zero();
      loss.aware = left_by(part, own_run, aware.lattice.kernel);
      loss.aware_seconds = own_run.total_seconds();
      losses.push_back(std::move(loss));
    }
  }
  return losses;
}

std::string motion_table_of(const std::vector<MotionLoss>& losses) {
  std::string text =
      "| path | acceleration, mm/s^2 | without a machine, nm; s | the same feeds on it, nm; s | dwell within its "
      "bounds, nm "
      "| planned for it and run on it, nm; s |\n|---|---|---|---|---|---|\n";
  for (const MotionLoss& l : losses) {
    text += fmt::format("| {} | {:g} | {:.4g}; {:.1f} | {:.4g}; {:.1f} | {:.4g} | {:.4g}; {:.1f} |\n", l.path,
                        l.acceleration, l.ideal, l.ideal_seconds, l.unaware, l.unaware_seconds, l.bounded, l.aware,
                        l.aware_seconds);
  }
  return text;
}

std::string motion_chart_of(const std::vector<MotionLoss>& losses) {
  ChartPanel left{"acceleration [mm/s^2]", "left, over the plan without accelerations", {}};
  ChartPanel seconds{"acceleration [mm/s^2]", "time of the run, over the same", {}};
  for (const SweptPath& path : kPaths) {
    for (const bool aware : {false, true}) {
      ChartLine quality{std::string(path.name) + (aware ? ", planned for the machine" : ""), path.colour, {}};
      quality.dashed = !aware;
      ChartLine time = quality;
      for (const MotionLoss& l : losses) {
        if (l.path != path.name) continue;
        quality.points.push_back({l.acceleration, (aware ? l.aware : l.unaware) / l.ideal, false});
        time.points.push_back({l.acceleration, (aware ? l.aware_seconds : l.unaware_seconds) / l.ideal_seconds, false});
      }
      left.lines.push_back(std::move(quality));
      seconds.lines.push_back(std::move(time));
    }
  }
  return draw_line_charts("What acceleration costs: feeds of dwell alone (dashed), and plans for the machine", "",
                          {left, seconds});
}

}  // namespace dwell::bench

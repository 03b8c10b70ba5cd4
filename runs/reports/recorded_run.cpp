#include "runs/reports/recorded_run.h"

#include <algorithm>
#include <cmath>

#include "paths/feed/lift_rests.h"
#include "paths/feed/step_times.h"
#include "runs/drawing/line_chart.h"
#include "runs/logs/log_file.h"
#include "runs/plan/program_prediction.h"
#include "runs/reports/log_report.h"

namespace dwell {
namespace {

constexpr Colour kExcess{31, 119, 180};
constexpr std::size_t kDrawnPoints = 4000;

double sum_of(const std::vector<double>& seconds, const AlignedLog& aligned) {
  double sum = 0.0;
  for (std::size_t i = aligned.first; i < aligned.end; ++i) sum += seconds[i];
  return sum;
}

std::vector<double> commanded_seconds(const Program& program) {
  std::vector<double> seconds;
  for (const ProgramStep& step : program.steps) seconds.push_back(step.seconds);
  return seconds;
}

/// A line through all points, or through the least and the largest of each group of them where there are too many.
std::vector<ChartPoint> drawn_points(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t group = x.size() / kDrawnPoints + 1;
  std::vector<ChartPoint> points;
  for (std::size_t i = 0; i < x.size(); i += group) {
    const auto begin = y.begin() + static_cast<std::ptrdiff_t>(i);
    const auto [least, most] =
        std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(std::min(group, x.size() - i)));
    points.push_back({x[i], *least, false});
    if (group > 1) points.push_back({x[i], *most, false});
  }
  return points;
}

}  // namespace

RecordedRun recorded_run(const LogSource& source, const Program& program, const std::optional<Machine>& machine,
                         const Part& part, const RemovalKernel& kernel, const HeightMap& simulated,
                         const Progress& progress) {
  RecordedRun run;
  progress.step("read");
  run.log = read_motion_log(source.file, source.reading, progress);
  progress.step("align");
  run.aligned = align_log(run.log, program, source.tolerance, progress);
  run.seconds = run.aligned.seconds();
  const std::vector<double> commanded = commanded_seconds(program);
  const std::vector<double> expected = machine ? step_times(program, *machine) : commanded;
  run.commanded_seconds = sum_of(commanded, run.aligned);
  if (machine) run.machine_seconds = sum_of(expected, run.aligned);
  double way = 0.0;
  for (std::size_t i = run.aligned.first; i < run.aligned.end; ++i) {
    run.ways.push_back(way + 0.5 * program.steps[i].length());
    way += program.steps[i].length();
    run.excess.push_back(run.aligned.step_seconds(i) - expected[i]);
  }
  // A log does not say when the tool is down, so settling is the machine's.
  const Machine settling = machine.value_or(Machine{});
  const ExactResidual left =
      predict_program(part, with_lift_rests(recorded_motion(run.log, run.aligned, program), settling), kernel,
                      progress.of_part("removal"));
  run.residual = left.statistics;
  HeightMap change = simulated;
  for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] -= left.surface.values[i];
  run.change = map_statistics(change, part.form, part.threads).rms_about_zero();
  return run;
}

std::string recorded_picture(const RecordedRun& run, const std::string& title, FigureFormat format) {
  std::vector<double> milliseconds, sum;
  double total = 0.0;
  for (const double seconds : run.excess) {
    milliseconds.push_back(1e3 * seconds);
    sum.push_back(total += seconds);
  }
  ChartPanel steps{"way along the path [mm]", "recorded less simulated time of a step [ms]", {}};
  ChartPanel sums{"way along the path [mm]", "the same, summed up [s]", {}};
  steps.lines.push_back({"", kExcess, drawn_points(run.ways, milliseconds), false});
  sums.lines.push_back({"", kExcess, drawn_points(run.ways, sum), false});
  for (ChartPanel* panel : {&steps, &sums}) panel->x_scale = panel->y_scale = AxisScale::Linear;
  return draw_line_charts(title, "", {steps, sums}, format);
}

nlohmann::ordered_json recorded_block(const RecordedRun& run) {
  nlohmann::ordered_json json{{"residual_rms_nm", run.residual.rms},
                              {"residual_pv_nm", run.residual.pv},
                              {"total_s", run.seconds},
                              {"commanded_s", run.commanded_seconds},
                              {"removal_change_rms_nm", run.change}};
  if (run.machine_seconds) json["machine_s"] = *run.machine_seconds;
  json["log"] = log_block(run.log, run.aligned);
  return json;
}

}  // namespace dwell

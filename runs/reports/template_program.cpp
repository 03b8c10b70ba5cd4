#include "runs/reports/template_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "paths/feed/exported_motion.h"
#include "paths/feed/machine_check.h"
#include "runs/job/program_style.h"
#include "runs/programs/template_reader.h"
#include "runs/programs/template_writer.h"

namespace dwell {
namespace {

/// What a schedule leaves to the rounding of a template's numbers: a share of the accelerations, and pieces of so many
/// steps of the clock at least.
struct RoundingTrial {
  double share, ticks;
};

constexpr std::array kTrials{RoundingTrial{0.97, 40}, RoundingTrial{0.94, 30}, RoundingTrial{0.9, 20},
                             RoundingTrial{0.85, 14}, RoundingTrial{0.8, 10},  RoundingTrial{0.7, 8}};

RoundingMargins margins_for(const ProgramTemplate& layout, const RoundingTrial& trial) {
  const RoundingMargins usual;
  const auto step_of = [&layout](const char* one, const char* other) {
    return std::max(layout.number(one).step(), layout.number(other).step());
  };
  RoundingMargins margins;
  margins.acceleration = trial.share;
  margins.place = std::max(usual.place, 1.5 * std::max(step_of("x", "dx"), step_of("y", "dy")));
  margins.least_piece = std::max(usual.least_piece, trial.ticks * step_of("t", "time"));
  return margins;
}

double seconds_at_work(const Program& program) {
  double seconds = 0.0;
  for (const ProgramStep& step : program.steps) seconds += step.removes ? step.seconds : 0.0;
  return seconds;
}

}  // namespace

std::string template_program_text(const PlannedJob& plan, const FeedTable& table,
                                  const std::vector<std::string>& comments, const Progress& progress) {
  const ProgramTemplate& layout = *plan.job.layout;
  const JobOptions& options = plan.job.options;
  const TemplateWriting writing{options.lift_height_mm, table.max_feed_mm_per_min, comments};
  if (!layout.speeds) return text_by_template(program_of(table), layout, writing, progress);
  if (!plan.program.motion) throw std::logic_error("a template with velocities needs the motion");
  const Machine machine = machine_for_program(plan.job.machine->machine, options);
  const auto text_of = [&](const Program& motion) {
    return text_by_template(motion_for_template(motion, layout, progress), layout, writing, progress);
  };
  const auto keeps_limits = [&](const std::string& text) {
    return beyond_machine(read_by_template(text, layout.output(), layout, progress), plan.job.machine->machine).empty();
  };
  std::string best = text_of(*plan.program.motion);
  if (machine.corner != CornerRule::ExactStop || keeps_limits(best)) return best;
  const double planned = seconds_at_work(*plan.program.motion);
  double least = std::numeric_limits<double>::infinity();
  for (const RoundingTrial& trial : kTrials) {
    progress.check();
    const Program motion = exported_motion(plan.program.table.path, plan.laid.motion, machine,
                                           dwell_options(plan.job).machine.feed_limits().max_feed,
                                           plan.dwell.motion->seconds, progress, margins_for(layout, trial));
    const double off = std::abs(seconds_at_work(motion) - planned);
    if (off >= least) continue;
    std::string text = text_of(motion);
    if (!keeps_limits(text)) continue;
    least = off;
    best = std::move(text);
  }
  return best;
}

}  // namespace dwell

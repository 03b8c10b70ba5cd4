#include "runs/plan/moved_program.h"

namespace dwell {

Program moved_program(Program program, const PlaneTransform& transform) {
  const Point origin = transform({});
  for (ProgramStep& step : program.steps) {
    step.start = transform(step.start);
    step.finish = transform(step.finish);
    if (!step.speeds) continue;
    step.speeds->in = transform(step.speeds->in) - origin;
    step.speeds->out = transform(step.speeds->out) - origin;
  }
  return program;
}

Program jittered_program(Program program, double deviation, RandomNumbers& random) {
  if (deviation == 0.0) return program;
  const auto beside = [&] { return Point{deviation * random.normal(), deviation * random.normal()}; };
  Point last;
  for (std::size_t k = 0; k < program.steps.size(); ++k) {
    ProgramStep& step = program.steps[k];
    const bool halts = step.start == step.finish;
    if (k == 0) last = step.start + beside();
    step.start = last;
    if (!halts) last = step.finish + beside();
    step.finish = last;
  }
  return program;
}

}  // namespace dwell

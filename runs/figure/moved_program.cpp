#include "runs/figure/moved_program.h"

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

}  // namespace dwell

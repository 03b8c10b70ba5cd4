#include "paths/feed/plan_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {

double dwell_within_feed(std::size_t point, double length, double dwell, double max_feed_mm_per_s) {
  if (!(dwell >= 0.0) || !std::isfinite(dwell)) {
    throw InputError(fmt::format("dwell of point {} = {} s; required finite and >= 0", point, dwell));
  }
  const double least = length / max_feed_mm_per_s;
  if (!(dwell * max_feed_mm_per_s >= length * (1.0 - 1e-6) - 4e-6)) {
    throw InputError(
        fmt::format("dwell of point {} = {} s; its stroke of {} mm takes at least {} s at maximum feed {} mm/s", point,
                    dwell, length, least, max_feed_mm_per_s));
  }
  return std::max(dwell, least);
}

Program program_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion, double max_feed_mm_per_s) {
  validate(path);
  if (dwell_s.size() != path.size()) {
    throw InputError(
        fmt::format("tool path has {} but {}", counted(path.size(), "point"), counted(dwell_s.size(), "dwell time")));
  }
  if (!(max_feed_mm_per_s > 0.0) || !std::isfinite(max_feed_mm_per_s)) {
    throw InputError(fmt::format("maximum feed = {} mm/s; required finite and > 0", max_feed_mm_per_s));
  }
  const StrokeMoves moves = stroke_moves(path, motion);
  Program program;
  program.steps.reserve(moves.size());
  program.fastest_feed = max_feed_mm_per_s;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    ProgramStep step = moves.steps[i];
    if (!step.removes) {
      program.rapid_length += step.length();
    } else if (moves.stroke[i] == StrokeMoves::kNoStroke) {
      step.seconds = step.length() / max_feed_mm_per_s;
    } else {
      const auto j = static_cast<std::size_t>(moves.stroke[i]);
      step.seconds = moves.share[i] * dwell_within_feed(j + 1, moves.length[j], dwell_s[j], max_feed_mm_per_s);
    }
    if (step.removes && step.start == step.finish && !(step.seconds > 0.0)) continue;
    program.steps.push_back(step);
  }
  return program;
}

}  // namespace dwell

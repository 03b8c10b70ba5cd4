#include "runs/plan/laid_path.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/counted.h"
#include "paths/feed/plan_program.h"

namespace dwell {
namespace {

ToolPath round_coordinates(ToolPath path) {
  constexpr double kPerMm = 1e6;
  for (Point& p : path.points) p = {std::round(p.x * kPerMm) / kPerMm, std::round(p.y * kPerMm) / kPerMm};
  path.lifted[0] = 1;
  return path;
}

}  // namespace

LaidPath lay_path(ToolPath path, Motion motion) {
  validate(path);
  LaidPath laid;
  laid.path = round_coordinates(std::move(path));
  laid.motion = motion;
  laid.metrics = path_metrics(laid.path);
  laid.strokes = strokes_of(laid.path, motion);
  return laid;
}

LaidPath lay_path(const Part& part, const PathSpec& spec, Motion motion, double max_feed, const Progress& progress) {
  progress.step("path: planning");
  ToolPath path = plan_path(spec, {part.figure, part.tif, max_feed, true, progress});
  progress.check();
  LaidPath laid = lay_path(std::move(path), motion);
  progress.step(fmt::format("path: {}, {:.4g} mm", counted(laid.path.size(), "dwell point"), laid.metrics.length));
  return laid;
}

}  // namespace dwell

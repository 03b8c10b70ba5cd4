#include "bench/schedule_case.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/random_numbers.h"
#include "paths/feed/least_dwell.h"

namespace dwell::bench {

ScheduleCase make_schedule_case(long strokes, bool rough) {
  constexpr long kLine = 1000;
  ToolPath raster{"raster", {}, {}};
  for (long row = 0; row * kLine < strokes; ++row) {
    for (long k = 0; k < kLine; ++k)
      raster.points.push_back({static_cast<double>(row % 2 == 0 ? k : kLine - 1 - k), static_cast<double>(row)});
  }
  raster.lifted.assign(raster.points.size(), 0);
  raster.lifted[0] = 1;
  ScheduleCase made;
  made.machine.max_feed = 50.0;
  made.machine.path_acceleration = 500.0;
  made.moves = stroke_moves(raster, Motion::Moving);
  made.path = kinematic_path(made.moves.steps, made.machine);
  made.dwell = least_dwell(made.moves, made.path, made.machine);
  RandomNumbers random(7);
  for (Eigen::Index j = 0; j < made.dwell.size(); ++j) {
    const Point p = raster.points[static_cast<std::size_t>(j)];
    double wanted = 0.1 + 0.05 * std::sin(0.02 * p.x) * std::cos(0.03 * p.y);
    if (rough) wanted *= 0.5 + random.uniform();
    made.dwell[j] = std::max(made.dwell[j], wanted);
  }
  return made;
}

}  // namespace dwell::bench

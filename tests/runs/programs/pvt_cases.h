#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/motion/program.h"
#include "core/motion/tool_path.h"
#include "paths/feed/exported_motion.h"
#include "runs/programs/feed_table.h"

namespace dwell::pvt_cases {

/// Two stretches that wind, a halt alone between lifts, and long strokes; no symmetry.
inline ToolPath lifted_path() {
  return {"file",
          {{0.1, -0.2},
           {1.3, 0.4},
           {2.5, 1.0},
           {2.1234567, 2.7},
           {-1.0, 2.0},
           {1.6, -1.0},
           {2.9, -1.0},
           {2.25, -1.0},
           {0.5, 0.5}},
          {1, 0, 0, 0, 1, 1, 0, 0, 0}};
}

inline Machine slow_machine(double acceleration = 20.0) {
  Machine machine;
  machine.path_acceleration = acceleration;
  machine.max_feed = 20.0;
  machine.x.max_acceleration = 0.9 * acceleration;
  machine.y.max_acceleration = 0.8 * acceleration;
  return machine;
}

inline std::vector<double> lifted_dwells() {
  return {0.9, 1.0 / 3.0, 0.75, 1.1, 5.5, 0.7123456789012, 1.1, 0.625, 1.3};
}

inline FeedTable made_by() {
  FeedTable table = feed_table_of(lifted_path(), lifted_dwells(), Motion::Moving, 1200.0);
  table.version = "0.0";
  table.inputs = {{"map mirror (2).csv", std::string(64, 'a')}};
  table.options = {{"tif_centre", "centroid"}};
  return table;
}

inline Program lifted_motion() {
  const FeedTable table = made_by();
  const Eigen::VectorXd seconds =
      Eigen::Map<const Eigen::VectorXd>(table.dwell_s.data(), static_cast<Eigen::Index>(table.dwell_s.size()));
  return exported_motion(table.path, Motion::Moving, slow_machine(), 20.0, seconds);
}

}  // namespace dwell::pvt_cases

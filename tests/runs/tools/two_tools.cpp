#include "tests/runs/tools/two_tools.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "runs/plan/least_dwell_of.h"

namespace dwell::test {
namespace {

JointTool tool_of(const std::string& name, RemovalFunction tif, const std::string& path, double price,
                  SolverKind solver) {
  JointTool tool;
  tool.name = name;
  tool.part = std::make_shared<const Part>(make_part(worked_surface(), std::move(tif), {true, true}, 1));
  tool.options.solver = solver;
  tool.laid = lay_path(*tool.part, parse_path_spec(path), Motion::Moving, tool.options.machine.feed_limits().max_feed);
  tool.price = price;
  return tool;
}

}  // namespace

HeightMap worked_surface() {
  HeightMap map(Grid{44, 56, 0.25, 0.25, {-4.25, 1.75}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const bool missing = i / map.grid.cols + i % map.grid.cols < 10;
    map.values[static_cast<std::size_t>(i)] =
        missing ? std::numeric_limits<double>::quiet_NaN()
                : 20.0 * std::sin(0.4 * p.x) * std::cos(0.3 * p.y + 0.2) + 0.3 * p.x * p.y + 4.0 * std::sin(1.5 * p.x);
  }
  return map;
}

std::vector<JointTool> two_tools(SolverKind solver, double small_peak) {
  return {tool_of("large", gaussian_removal(10.0, 5.0, 7.0), "raster:pitch=2,overrun=3", 1.0, solver),
          tool_of("small", gaussian_removal(small_peak, 1.6, 2.5), "raster:pitch=1,overrun=1,angle=90", 3.0, solver)};
}

Vector least_seconds(const JointTool& tool) { return least_dwell_of(tool.laid, tool.options.machine); }

}  // namespace dwell::test

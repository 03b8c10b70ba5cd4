// From an array of heights and a formula of the tool to a feed table, without reading a file: the four values of a
// plan.
//
//   plan_from_arrays > feed.csv
//
// It is built and run by the tests from the installed package, and ends with 1 if the plan does not do what it should.

#include <dwell/core/removal/simulate.h>
#include <dwell/paths/path_catalogue.h>
#include <dwell/runs/plan/dwell_plan.h>
#include <dwell/runs/plan/laid_path.h>
#include <dwell/runs/plan/machine_program.h>
#include <dwell/runs/plan/part.h>
#include <dwell/runs/programs/feed_table.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <vector>

namespace {

/// A round part of 40 mm on pixels of 0.5 mm: a bowl of 150 nm with a bump of 80 nm to the right of its middle. Heights
/// are in nm, row by row, row 0 at the smallest y; outside the part there is no data.
dwell::HeightMap made_up_map() {
  const dwell::Index n = 81;
  const double pitch = 0.5;
  dwell::HeightMap map(dwell::Grid{n, n, pitch, pitch, {-20.0, -20.0}});  // all pixels without data
  for (dwell::Index row = 0; row < n; ++row) {
    for (dwell::Index col = 0; col < n; ++col) {
      const double x = map.grid.x(col), y = map.grid.y(row);
      if (std::hypot(x, y) > 20.0) continue;
      map.at(row, col) = 150.0 * (x * x + y * y) / 400.0 + 80.0 * std::exp(-((x - 8.0) * (x - 8.0) + y * y) / 18.0);
    }
  }
  return map;
}

void print_before_and_after(const dwell::Part& part, const dwell::MapStatistics& after, double seconds) {
  std::fprintf(stderr, "before %.2f nm RMS, after %.2f nm RMS, in %.1f s\n", part.before.rms, after.rms, seconds);
}

int run() {
  // The part: heights, removal function (peak 10 nm/s, 4 mm wide at half of it, nothing beyond 5 mm from the axis), and
  // what the specification does not count: piston and tilt.
  const dwell::Part part = dwell::make_part(made_up_map(), dwell::gaussian_removal(10.0, 4.0, 5.0), {true, true});

  // The path, and the machine that runs it.
  dwell::DwellOptions options;
  options.machine.max_feed_mm_per_min = 3000.0;
  const dwell::LaidPath laid = dwell::lay_path(part, dwell::parse_path_spec("raster:pitch=1"), dwell::Motion::Moving,
                                               options.machine.feed_limits().max_feed);

  // The dwell times, and the program that spends them.
  const dwell::DwellPlan plan = dwell::find_dwell(part, laid, options);
  const dwell::MachineProgram program = dwell::make_machine_program(laid, plan, options.machine);
  std::fputs(dwell::feed_table_text(program.table).c_str(), stdout);

  // What the program does to the part, the tool moving as the table says.
  const dwell::Program steps = dwell::program_of(program.table);
  const dwell::HeightMap removal = dwell::simulate(steps, part.map, part.kernel, part.threads);
  const dwell::MapStatistics after = dwell::map_statistics(dwell::surface_after(part.map, removal), part.form);
  print_before_and_after(part, after, steps.total_seconds());

  const bool certain = plan.solver.converged() && plan.limits.empty() && program.limits.empty();
  return certain && after.rms <= 0.05 * part.before.rms ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plan_from_arrays: %s\n", error.what());
    return 2;
  }
}

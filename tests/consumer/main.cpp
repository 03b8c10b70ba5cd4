// Uses the installed headers and libraries; exits with 1 if what they compute is wrong.

#include <dwell/core/map/height_map.h>
#include <dwell/core/motion/program.h>
#include <dwell/core/motion/tool_path.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  dwell::HeightMap map(dwell::Grid{2, 3, 0.5, 0.5, {0.0, 0.0}});
  map.at(1, 2) = 4.0;

  const dwell::ToolPath path{"file", {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, {1, 0, 0}};
  dwell::Program program;
  for (const dwell::Stroke& stroke : dwell::moving_strokes(path)) {
    program.steps.push_back({stroke.start, stroke.finish, 2.0});
  }
  // Three points a millimetre apart, extended by half a step at either end; two seconds each.
  const double length = program.removing_length();
  const double seconds = program.total_seconds();
  const bool right = map.valid_pixels() == 1 && std::abs(length - 3.0) <= 1e-12 && std::abs(seconds - 6.0) <= 1e-12;
  std::printf("%td valid pixels, %g mm in %g s\n", map.valid_pixels(), length, seconds);
  return right ? 0 : 1;
}

#pragma once

#include <string>

namespace dwell {

/// A distance that a planner's options ask for between neighbouring tracks or dwell points. It must not exceed the
/// width of the tool, or there are places that the tool never touches.
struct PathDistance {
  std::string option;  // as the user writes it: "pitch"
  double value = 0.0;  // [mm]; 0 = not given
};

}  // namespace dwell

#include "bench/peer_limit.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/json_access.h"
#include "bench/solve_run.h"

namespace dwell::bench {

double peer_limit(double auto_seconds) { return std::max(kPeerTimes * auto_seconds, kLeastPeerSeconds); }

std::optional<double> times_given(const nlohmann::json& run) {
  if (!run.contains("times_given") || run.at("times_given").is_null()) return std::nullopt;
  return number(run, "times_given");
}

std::optional<std::string> not_there(const nlohmann::json& run) {
  const std::optional<double> times = times_given(run);
  if (!times) return std::nullopt;
  const bool late = run.contains("late");
  if (!late) {
    if (!run.contains("reached") || !run.at("reached").at("objective").at(kOnePercent).is_null()) return std::nullopt;
    if (text_of(run, "status") != "time limit") return std::nullopt;
  }
  return fmt::format("not there at {:.3g} x", *times);
}

std::string why_not_taken(double points, double pixels, double largest) {
  constexpr double kFits = 2.0;  // [GiB], with the copies and factors that such solvers make
  const double other = pixels > 0.0 ? pixels : points, gib = 8.0 * points * other / 0x1p30;
  if (gib > kFits)
    return fmt::format("too large: its matrix of {:.0f} x {:.0f} numbers takes {:.3g} GiB", other, points, gib);
  return fmt::format("not meant for it: takes at most {:.0f} dwell points, as its work grows with their cube", largest);
}

}  // namespace dwell::bench

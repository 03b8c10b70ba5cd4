#include "runs/reports/travel_words.h"

#include <fmt/format.h>

#include "runs/reports/machine_report.h"

namespace dwell {

std::string travel_words(const TravelTimes& travel) {
  const std::string stops =
      travel.between_stops > 0.0 ? fmt::format("moves between stops {:.2f} s, ", travel.between_stops) : "";
  const std::string rests = lift_words(travel.rests);
  return stops +
         fmt::format("lifted moves {:.2f} s and the way down {:.2f} s, at maximum feed", travel.lifted, travel.down) +
         (rests.empty() ? "" : "; " + rests);
}

}  // namespace dwell

#pragma once

#include <string>

namespace dwell {

/// Seconds for people: "425.07 s", and from ten minutes on also in hours, "7661.32 s (2:07:41)", or days,
/// "4147200.00 s (48 d 0:00:00)".
std::string duration_text(double seconds);

/// The brackets of the above alone, "2:07:41", for times under ten minutes as well; empty where there are no hours to
/// be counted (negative, infinite).
std::string clock_text(double seconds);

}  // namespace dwell

#pragma once

#include <string>

namespace dwell {

/// What F means in a G-code program. G94: feed in mm/min. G93 gives each move its time, and controllers disagree how.
/// G93PerMinute: F = 1 / (duration of the move in minutes), as RS274/NGC has it (Kramer, Proctor and Messina, NISTIR
/// 6556, 2000, "Set Feed Rate Mode"). G93Seconds: F = duration of the move in seconds (Beckhoff and ISG kernels).
enum class GcodeDialect { G94, G93PerMinute, G93Seconds };

/// Parses "g94", "g93-per-minute" or "g93-seconds". Throws InputError naming the text and the accepted words.
GcodeDialect parse_gcode_dialect(const std::string& text);
std::string to_string(GcodeDialect dialect);

}  // namespace dwell

#pragma once

#include <string>

namespace dwell {

/// How a program for a machine says its speeds. Constant: one feed a stroke, as plain G-code does. Linear: speeds at
/// nodes with constant acceleration between them. Pvt: positions and velocities at nodes with cubics of time between
/// them, which turn a corner that is not stopped at into a curve.
enum class ScheduleKind { Constant, Linear, Pvt };

/// Parses "constant", "linear" or "pvt". Throws InputError naming the text and the accepted words.
ScheduleKind parse_schedule_kind(const std::string& text);
std::string to_string(ScheduleKind kind);

}  // namespace dwell

#include "runs/programs/gcode_reading.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

HaltUnit parse_halt_unit(const std::string& text) {
  if (text == "s") return HaltUnit::Seconds;
  if (text == "ms") return HaltUnit::Milliseconds;
  throw InputError(fmt::format("g4 = \"{}\"; accepted: s, ms", text));
}

std::string to_string(HaltUnit unit) { return unit == HaltUnit::Milliseconds ? "ms" : "s"; }

}  // namespace dwell

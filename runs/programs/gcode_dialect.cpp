#include "runs/programs/gcode_dialect.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

GcodeDialect parse_gcode_dialect(const std::string& text) {
  if (text == "g94") return GcodeDialect::G94;
  if (text == "g93-per-minute") return GcodeDialect::G93PerMinute;
  if (text == "g93-seconds") return GcodeDialect::G93Seconds;
  throw InputError(fmt::format("gcode = \"{}\"; accepted: g94, g93-per-minute, g93-seconds", text));
}

std::string to_string(GcodeDialect dialect) {
  switch (dialect) {
    case GcodeDialect::G93PerMinute:
      return "g93-per-minute";
    case GcodeDialect::G93Seconds:
      return "g93-seconds";
    case GcodeDialect::G94:
      break;
  }
  return "g94";
}

}  // namespace dwell

#include "paths/feed/schedule_kind.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

ScheduleKind parse_schedule_kind(const std::string& text) {
  for (const ScheduleKind kind : {ScheduleKind::Constant, ScheduleKind::Linear, ScheduleKind::Pvt}) {
    if (text == to_string(kind)) return kind;
  }
  throw InputError(fmt::format("schedule = \"{}\"; accepted: constant, linear, pvt", text));
}

std::string to_string(ScheduleKind kind) {
  switch (kind) {
    case ScheduleKind::Constant:
      return "constant";
    case ScheduleKind::Linear:
      return "linear";
    case ScheduleKind::Pvt:
      break;
  }
  return "pvt";
}

}  // namespace dwell

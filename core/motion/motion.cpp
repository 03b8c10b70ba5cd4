#include "core/motion/motion.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

Motion parse_motion(const std::string& text) {
  if (text == "moving") return Motion::Moving;
  if (text == "stop") return Motion::Stop;
  throw InputError(fmt::format("motion = \"{}\"; accepted: moving, stop", text));
}

std::string to_string(Motion motion) { return motion == Motion::Moving ? "moving" : "stop"; }

}  // namespace dwell

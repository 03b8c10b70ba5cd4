#pragma once

#include <fmt/format.h>

#include <string>

#include "core/base/errors.h"

namespace dwell {

/// "yes" or "true", "no" or "false". Throws InputError with the value and what is accepted.
inline bool yes_or_no(const std::string& text) {
  if (text == "yes" || text == "true") return true;
  if (text == "no" || text == "false") return false;
  throw InputError(fmt::format("'{}'; accepted: yes, no", text));
}

}  // namespace dwell

#pragma once

#include <functional>
#include <string>

#include "core/base/errors.h"

namespace dwell {

/// Told now and then how far a long computation is, in words with units; false = stop. May be empty.
using Progress = std::function<bool(const std::string& line)>;

/// Throws Interrupted if the listener says stop.
inline void tell(const Progress& progress, const std::string& line) {
  if (progress && !progress(line)) throw Interrupted();
}

}  // namespace dwell

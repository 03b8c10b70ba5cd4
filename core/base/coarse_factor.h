#pragma once

#include "core/base/grid.h"

namespace dwell {

/// A coarse pitch, in pixels of a map.
struct CoarseFactor {
  Index x = 1;
  Index y = 1;

  bool operator==(const CoarseFactor&) const = default;
};

}  // namespace dwell

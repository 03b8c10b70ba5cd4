#pragma once

#include "core/tif/removal_function.h"

namespace dwell {

/// The removal function of a tool that takes `rate` times the volume in a second and is `width` times as wide, both >
/// 0: b'(r) = rate / width^2 b(r / width). Its volume rate is `rate` times that of `tif`, its peak rate / width^2
/// times. Throws std::invalid_argument for factors that are not finite and > 0. Cost O(samples).
RemovalFunction scaled_removal(const RemovalFunction& tif, double rate, double width);

}  // namespace dwell

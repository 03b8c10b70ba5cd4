#pragma once

namespace dwell {

/// The share of a length that rounding may change. What lies exactly on a limit counts as this much further inside, so
/// that the answer does not depend on where the part is placed.
inline constexpr double kRounding = 1e-9;

}  // namespace dwell

#pragma once

namespace dwell {

/// How much of a length rounding may take or add: what lies exactly on a limit is decided as if it were this much
/// further in, so that the answer is the same wherever the part is placed.
inline constexpr double kRounding = 1e-9;

}  // namespace dwell

#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace dwell::bench {

/// A solver is given so many times as long as `auto` took to within 1 %; "not there" by then is a result.
inline constexpr double kPeerTimes = 12.0;
/// But at least so long, since below that the start of a process and its threads decides and not the method [s].
inline constexpr double kLeastPeerSeconds = 0.5;

/// The time that a solver other than `auto` has on a scenario [s].
double peer_limit(double auto_seconds);

/// How many times as long as `auto` a run was given: that it did not arrive by then is what the tables say.
/// Nothing if the run has no limit of that kind.
std::optional<double> times_given(const nlohmann::json& run);

/// "not there at 12 x", or nothing if the run arrived within 1 %, ended by itself, or was not started.
std::optional<std::string> not_there(const nlohmann::json& run);

/// Why a solver that takes at most `largest` dwell points cannot take a problem of more: the matrix that it needs is
/// too large, with its size, or where that would fit, its work is. `pixels` 0 = it needs the square matrix of the dwell
/// points alone.
std::string why_not_taken(double points, double pixels, double largest);

}  // namespace dwell::bench

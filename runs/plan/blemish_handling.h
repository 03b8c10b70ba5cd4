#pragma once

#include <string>
#include <string_view>

namespace dwell {

/// What a plan does about blemishes, which are found in what it leaves (core/anatomy/blemishes.h).
///   Report    says where they are and what is left without them
///   LeaveOut  gives their pixels weight 0 in the fit and solves once more; what is left with them is said beside it
///   Keep      does not look for them
enum class BlemishHandling { Report, LeaveOut, Keep };

/// "report", "leave-out" or "keep"; throws InputError for anything else.
BlemishHandling parse_blemish_handling(std::string_view text);
std::string to_string(BlemishHandling handling);

}  // namespace dwell

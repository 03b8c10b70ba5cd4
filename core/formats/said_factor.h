#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// Whether the value under a name for a factor, an offset, an exponent, a prefix, a sign or a norm leaves the heights
/// as they are: 1 for a factor, 0 for an offset or an exponent, no prefix, the sign +, not normalised. `name` is as in
/// the file. Cost O(length).
bool leaves_heights(std::string_view name, const std::vector<double>& numbers, const std::vector<std::string>& texts);

/// Whether the value under such a name may be a word: a sign, a prefix, a norm.
bool may_be_a_word(std::string_view name);

/// The number that leaves the heights as they are, for messages: 0 for what is added, else 1.
double neutral_number(std::string_view name);

}  // namespace dwell

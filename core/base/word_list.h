#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

namespace dwell {

/// Whether the word is one of a list, as it stands.
template <class Words>
bool is_among(std::string_view word, const Words& words) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace dwell

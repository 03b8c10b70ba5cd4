#include "runs/programs/axis_words.h"

#include <fmt/format.h>

namespace dwell {

std::string why_no_axis(char letter, AxisLetters letters) {
  if (letter == letters.x || letter == letters.y || kAxisLetters.find(letter) == std::string_view::npos) return "";
  // Of a machine with the usual letters, what others mean is for each reader to say.
  if (letters == AxisLetters{} && letter != 'X' && letter != 'Y') return "";
  return fmt::format(
      "{} is no axis of the machine, whose letters are {} and {} (letter of [x] and [y] in its file); required these",
      letter, letters.x, letters.y);
}

}  // namespace dwell

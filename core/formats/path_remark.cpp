#include "core/formats/path_remark.h"

#include <algorithm>
#include <array>

#include "core/formats/remark_factors.h"
#include "core/formats/remark_orientation.h"
#include "core/formats/remark_places.h"
#include "core/formats/said_orientation.h"

namespace dwell {
namespace {

/// "pixels", "in pixels", "pixel coordinates", but not "3 pixels wide".
bool are_in_pixels(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 6> kPixelUnits{"pixel", "pixels", "px", "pix", "bildpunkte", "voxels"};
  if (!is_among(words[at].folded, kPixelUnits) || follows_a_number(words, at)) return false;
  return words.size() == 1 || is_announced(words, at);
}

/// The axis in the plane of the path that the word names; a letter x behind a number means times.
bool names_axis(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 10> kAxes{"x",      "y",      "xy",     "x-axis",  "y-axis",
                                                   "x_axis", "y_axis", "x-axes", "xy-axes", "x/y"};
  return is_among(words[at].folded, kAxes) && !(at > 0 && words[at - 1].number);
}

/// Whether the word is what a statement of the axes has as its subject: "axes", "coordinates", "x". Of one axis its
/// letter must be said: rotary ones turn in every program.
bool is_of_the_axes(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 6> kSubjects{"axes",       "coordinates",      "coords",
                                                      "coordinate", "coordinatesystem", "koordinaten"};
  return is_among(words[at].folded, kSubjects) || names_axis(words, at);
}

/// "X AND Y SWAPPED", "axes rotated 90", "coordinates mirrored in Y", "program mirrored".
bool says_axes_turned(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 17> kTurned{
      "swapped",  "exchanged",  "interchanged", "rotated", "mirrored", "flipped",
      "inverted", "reversed",   "transposed",   "negated", "scaled",   "vertauscht",
      "gedreht",  "gespiegelt", "invertiert",   "turned",  "switched"};
  constexpr std::array<std::string_view, 6> kWholes{"program", "path", "toolpath", "tool-path", "points", "programm"};
  constexpr std::array<std::string_view, 4> kOfWholes{"mirrored", "transposed", "rotated", "gespiegelt"};
  constexpr std::size_t kReach = 3;
  if (!is_among(words[at].folded, kTurned) || is_denied(words, at)) return false;
  const bool by = at + 1 < words.size() && (words[at + 1].folded == "by" || words[at + 1].folded == "to");
  const std::size_t next = at + (by ? 2 : 1);
  if (next < words.size() && number_of(words[next]) == std::optional(0.0)) return false;
  for (std::size_t i = at > kReach ? at - kReach : 0; i < std::min(words.size(), at + kReach); ++i) {
    if (is_of_the_axes(words, i)) return true;
    if (i < at && is_among(words[i].folded, kWholes) && is_among(words[at].folded, kOfWholes)) return true;
  }
  return false;
}

/// "swap x and y", "swap xy", "x is y", "x = -y".
bool says_axes_exchanged(const Remark& words, std::size_t at) {
  const std::string& word = words[at].folded;
  if (word == "swapxy" || word == "swap_xy") return true;
  if (word == "swap" && at + 1 < words.size()) return is_of_the_axes(words, at + 1);
  if ((word != "x" && word != "y") || at + 1 >= words.size()) return false;
  const std::size_t other = words[at + 1].folded == "is" ? at + 2 : at + 1;
  const bool equal = other == at + 2 || words[other].before == '=';
  if (!equal || other >= words.size()) return false;
  const std::string& what = words[other].folded;
  return what == (word == "x" ? "y" : "x") || what == "-x" || what == "-y";
}

/// "Y axis down", "x to the left".
bool says_axis_against_ours(const Remark& words, std::size_t at) {
  constexpr std::size_t kLongest = 5;  // words
  if (!names_axis(words, at)) return false;
  std::string name = words[at].folded;
  for (std::size_t i = at + 1; i < std::min(words.size(), at + kLongest) && !words[i].clause; ++i) {
    name += words[i].folded;
    if (const auto claim = read_axis_claim(name, "yes")) return !claim->usual;
  }
  return false;
}

/// "coordinate rotation 90", "axes rotation: 90 deg".
bool says_rotation_of_axes(const Remark& words, std::size_t at) {
  if (words[at].folded != "rotation" || at == 0 || !is_of_the_axes(words, at - 1)) return false;
  return at + 1 < words.size() && number_of(words[at + 1]).value_or(0.0) != 0.0;
}

}  // namespace

std::optional<std::string> find_other_axes(std::string_view comment) {
  const Remark words = remark_words(comment);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (says_axes_turned(words, i) || says_axes_exchanged(words, i) || says_axis_against_ours(words, i) ||
        says_rotation_of_axes(words, i)) {
      return "other axes than x to the right and y up";
    }
    if (speaks_of_places(words, i) || are_in_pixels(words, i)) return "places in another unit than mm";
  }
  return std::nullopt;
}

std::optional<std::string> find_other_places(std::string_view comment) {
  const Remark words = remark_words(comment);
  if (speaks_of_axes(words)) return "other axes than x to the right and y up";
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (speaks_of_places(words, i) || are_in_pixels(words, i)) return "places in another unit than mm";
    if (speaks_of_a_shift(words, i)) return "a shift of the coordinates";
    if (is_a_factor(words, i)) return "a factor of the numbers";
  }
  return std::nullopt;
}

}  // namespace dwell

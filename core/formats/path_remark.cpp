#include "core/formats/path_remark.h"

#include <algorithm>
#include <array>

#include "core/formats/remark_factors.h"
#include "core/formats/remark_orientation.h"
#include "core/formats/remark_places.h"

namespace dwell {
namespace {

/// "pixels", "in pixels", "pixel coordinates", but not "3 pixels wide".
bool are_in_pixels(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 6> kPixelUnits{"pixel", "pixels", "px", "pix", "bildpunkte", "voxels"};
  if (!is_among(words[at].folded, kPixelUnits) || follows_a_number(words, at)) return false;
  return words.size() == 1 || is_announced(words, at);
}

}  // namespace

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

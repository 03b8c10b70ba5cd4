#include "runs/map_steps/blemish_step.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/anatomy/blemishes.h"

namespace dwell {

std::string run_blemishes(HeightMap& map, const MapStep& step, MapStepContext& context) {
  constexpr std::size_t kNamed = 3;
  const BlemishOptions options{step.number("width"), step.number("sigmas")};
  const std::vector<Blemish> found = find_blemishes(map, options, context.threads, context.progress);
  const Index before = map.valid_pixels();
  map = without_blemishes(std::move(map), found);
  std::string text = fmt::format("{} blemishes of {} pixels removed", found.size(), before - map.valid_pixels());
  for (std::size_t k = 0; k < std::min(kNamed, found.size()); ++k) {
    const Blemish& b = found[k];
    text += fmt::format("{} {:.2f} x {:.2f} mm, {:+.3g} nm at ({:.4g}, {:.4g}) mm", k == 0 ? ":" : ",", b.length,
                        b.width, b.height, b.place.x, b.place.y);
  }
  return text + (found.size() > kNamed ? ", ..." : "");
}

}  // namespace dwell

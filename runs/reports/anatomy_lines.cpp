#include "runs/reports/anatomy_lines.h"

#include <fmt/format.h>

#include <algorithm>

#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShown = 5;  // blemishes in a table

std::string blemish_lines(const ResidualAnatomy& a, const MapStatistics& with) {
  if (!a.searched) return "blemishes not looked for\n";
  if (a.blemishes.empty()) return "";
  std::string text = fmt::format("blemishes {} on {} pixels; {} without them, RMS {:.4g} nm with all\n",
                                 a.blemishes.size(), a.blemish_pixels, in_words(a.without), with.rms);
  const std::size_t shown = std::min(kShown, a.blemishes.size());
  double others = a.mean_square.blemishes;
  for (std::size_t k = 0; k < shown; ++k) {
    const Blemish& b = a.blemishes[k];
    others -= a.of_blemish[k];
    text += fmt::format(
        "          {}: at ({:.4g}, {:.4g}) mm, {:.2f} x {:.2f} mm, {:+.3g} nm, {:.3g} % of the mean square\n", k + 1,
        b.place.x, b.place.y, b.length, b.width, b.height, 100.0 * a.share(a.of_blemish[k]));
  }
  if (shown < a.blemishes.size()) {
    text += fmt::format("          and {} more, {:.2g} % together\n", a.blemishes.size() - shown,
                        100.0 * a.share(std::max(0.0, others)));
  }
  return text;
}

}  // namespace

std::string anatomy_lines(const ResidualAnatomy& a, const MapStatistics& with) {
  const ResidualShares& s = a.mean_square;
  const auto percent = [&](double part) { return 100.0 * a.share(part); };
  return fmt::format(
             "left      of the mean square {:.1f} % blemishes, {:.1f} % in the zone of {:.3g} mm at the edge ({:.1f} % "
             "of "
             "the area)\n"
             "          and inside {:.1f} % in waves < {:.4g} mm (the FWHM), {:.1f} % to {:.4g} mm, {:.1f} % longer\n",
             percent(s.blemishes), percent(s.edge), a.edge.width,
             100.0 * static_cast<double>(a.edge_pixels) / static_cast<double>(a.pixels), percent(s.shorter), a.fwhm,
             percent(s.middle), kLongInFwhm * a.fwhm, percent(s.longer)) +
         blemish_lines(a, with);
}

Json anatomy_block(const ResidualAnatomy& a, const std::string& advice) {
  const ResidualShares& s = a.mean_square;
  Json found = Json::array();
  for (std::size_t k = 0; k < std::min(kListedBlemishes, a.blemishes.size()); ++k) {
    const Blemish& b = a.blemishes[k];
    found.push_back({{"place_mm", {b.place.x, b.place.y}},
                     {"length_mm", b.length},
                     {"width_mm", b.width},
                     {"height_nm", b.height},
                     {"pixels", b.pixels.size()},
                     {"share", a.share(a.of_blemish[k])}});
  }
  return {{"mean_square_nm2", s.whole()},
          {"fwhm_mm", a.fwhm},
          {"edge_width_mm", a.edge.width},
          {"edge_share_of_area", static_cast<double>(a.edge_pixels) / static_cast<double>(a.pixels)},
          {"shares",
           {{"blemishes", a.share(s.blemishes)},
            {"edge", a.share(s.edge)},
            {"shorter", a.share(s.shorter)},
            {"middle", a.share(s.middle)},
            {"longer", a.share(s.longer)}}},
          {"blemishes",
           {{"searched", a.searched},
            {"count", a.blemishes.size()},
            {"pixels", a.blemish_pixels},
            {"found", found},
            {"without",
             {{"rms_nm", a.without.rms},
              {"pv_nm", a.without.pv},
              {"pvr_nm", finite_or_null(a.without.pvr)},
              {"mean_nm", a.without.mean}}}}},
          {"advice", advice}};
}

}  // namespace dwell

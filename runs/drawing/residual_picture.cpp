#include "runs/drawing/residual_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/numerics/median.h"
#include "runs/drawing/colour_map.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/plot_field.h"

namespace dwell {
namespace {

constexpr double kRingMargin = 3.0, kLeastRing = 6.0;  // around a blemish, and its least radius [units]
const TextStyle kNumber{11.0, true};

/// 1.4826 times the median of the absolute values; of many, of some million at equal distances.
double robust_sigma(const HeightMap& map) {
  constexpr std::size_t kEnough = 1000000;
  const std::size_t step = map.values.size() <= kEnough ? 1 : (map.values.size() / kEnough) | 1U;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < map.values.size(); i += step) {
    if (std::isfinite(map.values[i])) sizes.push_back(std::abs(map.values[i]));
  }
  return sizes.empty() ? 0.0 : kSigmaPerMedianDeviation * upper_median(std::move(sizes));
}

/// Places of the part on the sheet.
class PlaceOnSheet {
 public:
  PlaceOnSheet(const PlotField& field, const SheetBox& box) : field_(field), box_(box) {}

  Point operator()(Point p) const {
    return {box_.left + box_.width * (p.x - field_.left) / (field_.right - field_.left),
            box_.bottom() - box_.height * (p.y - field_.bottom) / (field_.top - field_.bottom)};
  }
  double units_per_mm() const { return box_.width / (field_.right - field_.left); }

 private:
  const PlotField& field_;
  SheetBox box_;
};

/// Calls line(from, to) [mm] along the sides of pixels in a row of which one lies in the zone and the other inside;
/// with `upright` in a column.
template <class Line>
void for_border(const HeightMap& map, const EdgeZone& zone, bool upright, const Line& line) {
  const Grid& g = map.grid;
  const Index lines = upright ? g.cols : g.rows, along = upright ? g.rows : g.cols;
  const auto pixel = [&](Index k, Index j) { return upright ? g.index(j, k) : g.index(k, j); };
  const auto corner = [&](Index k, Index j) {
    const auto a = static_cast<double>(k) + 0.5, b = static_cast<double>(j) - 0.5;
    return upright ? Point{g.origin.x + a * g.pitch_x, g.origin.y + b * g.pitch_y}
                   : Point{g.origin.x + b * g.pitch_x, g.origin.y + a * g.pitch_y};
  };
  for (Index k = 0; k + 1 < lines; ++k) {
    Index begin = -1;
    for (Index j = 0; j <= along; ++j) {
      bool border = false;
      if (j < along) {
        const auto one = static_cast<std::size_t>(pixel(k, j)), other = static_cast<std::size_t>(pixel(k + 1, j));
        border = zone.holds[one] != zone.holds[other] && std::isfinite(map.values[one] + map.values[other]);
      }
      if (border && begin < 0) begin = j;
      if (border || begin < 0) continue;
      line(corner(k, begin), corner(k, j));
      begin = -1;
    }
  }
}

/// A ring around a blemish, and around others that lie in it.
struct Ring {
  Point centre;
  double radius;
  std::string numbers;
};

std::vector<Ring> rings_of(const ResidualAnatomy& anatomy, const PlaceOnSheet& place) {
  std::vector<Ring> rings;
  for (std::size_t k = 0; k < std::min(kRinged, anatomy.blemishes.size()); ++k) {
    const Blemish& b = anatomy.blemishes[k];
    const double radius = std::max(kLeastRing, 0.5 * b.length * place.units_per_mm() + kRingMargin);
    const Point centre = place(b.place);
    const auto around = std::find_if(rings.begin(), rings.end(), [&](const Ring& ring) {
      return distance(ring.centre, centre) < ring.radius + 0.5 * kLeastRing;
    });
    if (around == rings.end()) {
      rings.push_back({centre, radius, fmt::format("{}", k + 1)});
    } else {
      around->numbers += fmt::format(", {}", k + 1);
    }
  }
  return rings;
}

void draw_ring(Sheet& sheet, const Ring& around, const SheetBox& box) {
  const auto& [centre, radius, number] = around;
  constexpr int kCorners = 40;
  std::vector<Point> ring;
  for (int k = 0; k <= kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    ring.push_back(centre + radius * Point{std::cos(angle), std::sin(angle)});
  }
  sheet.polyline(ring, {kPaper, 3.0});
  sheet.polyline(ring, {kInk, 1.2});
  // The number stands where there is room: on the right, or on the left of the ring near the right edge.
  const double width = Sheet::text_width(number, kNumber), gap = radius + 2.0;
  const double left = centre.x + gap + width < box.right() ? centre.x + gap : centre.x - gap - width;
  const double baseline =
      std::clamp(centre.y + kMiddleToBaseline * kNumber.size, box.top + kNumber.size, box.bottom() - 2.0);
  TextStyle halo = kNumber;
  halo.colour = kPaper;
  for (const Point shift : {Point{-1, 0}, Point{1, 0}, Point{0, -1}, Point{0, 1}})
    sheet.text(Point{left, baseline} + shift, number, halo);
  sheet.text({left, baseline}, number, kNumber);
}

}  // namespace

std::string residual_picture(const HeightMap& residual, const ResidualAnatomy& anatomy, const std::string& title,
                             FigureFormat format, const Progress& progress, const HeightMap* counted) {
  const PlotField field = field_of_map(residual, field_edges(1), progress);
  const double end = kColourSigmas * robust_sigma(counted != nullptr ? *counted : residual);
  const ColourLimits limits = end > 0.0 ? colour_limits(residual.values, ColourMap::Diverging, -end, end)
                                        : colour_limits(residual.values, ColourMap::Diverging);
  progress.check();
  const auto over = [&](Sheet& sheet, const SheetBox& box) {
    const PlaceOnSheet place(field, box);
    for (const bool upright : {false, true}) {
      for_border(residual, anatomy.edge, upright, [&](Point from, Point to) {
        sheet.line(place(from), place(to), {kInk, 0.8});
      });
    }
    for (const Ring& ring : rings_of(anatomy, place)) draw_ring(sheet, ring, box);
  };
  const std::string legend = fmt::format(
      "colours end at {:g} robust standard deviations ({:.3g} nm); line: zone of {:.3g} mm at the edge{}",
      kColourSigmas, limits.upper, anatomy.edge.width, anatomy.blemishes.empty() ? "" : "; rings: blemishes");
  return draw_maps(title, {{field, ColourMap::Diverging, limits, legend, "nm", over}}, format).bytes;
}

}  // namespace dwell

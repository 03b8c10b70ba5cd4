#include "runs/drawing/picture.h"

#include "runs/drawing/colour_map.h"
#include "runs/drawing/plot.h"
#include "runs/drawing/plot_field.h"

namespace dwell {
namespace {

std::string picture(const PlotField& field, const std::vector<double>& values, const PictureOptions& options,
                    const std::string& unit) {
  const ColourMap map = options.diverging ? ColourMap::Diverging : ColourMap::Sequential;
  const ColourLimits limits = colour_limits(values, map, options.lower, options.upper);
  return draw_plot(field, map, limits, options.title, unit).canvas.png();
}

}  // namespace

std::string map_picture(const HeightMap& map, const PictureOptions& options) {
  return picture(field_of_map(map), map.values, options, options.unit);
}

std::string dwell_picture(const ToolPath& path, const std::vector<double>& dwell, const PictureOptions& options) {
  return picture(field_of_dwell(path, dwell), dwell, options, options.unit.empty() ? "s" : options.unit);
}

}  // namespace dwell

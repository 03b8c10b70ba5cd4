#include "runs/drawing/picture.h"

#include "runs/drawing/colour_map.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/plot_field.h"

namespace dwell {
namespace {

std::string picture(PlotField field, const std::vector<double>& values, const PictureOptions& options,
                    const std::string& unit, FigureFormat format, const Progress& progress) {
  progress.check();
  const ColourMap map = options.diverging ? ColourMap::Diverging : ColourMap::Sequential;
  const ColourLimits limits =
      options.range == nullptr
          ? colour_limits(values, map, options.lower, options.upper)
          : same_limits(colour_limits(options.range->values, map, options.lower, options.upper), values);
  progress.check();
  return draw_maps(options.title, {{std::move(field), map, limits, "", unit}}, format).bytes;
}

}  // namespace

std::string map_picture(const HeightMap& map, const PictureOptions& options, FigureFormat format,
                        const Progress& progress) {
  return picture(field_of_map(map, field_edges(1), progress), map.values, options, options.unit, format, progress);
}

std::string after_picture(const HeightMap& before, const HeightMap& after, FigureRange range, const std::string& title,
                          FigureFormat format, const Progress& progress, const HeightMap* own_range) {
  if (range == FigureRange::Own) return map_picture(after, {title, "nm", true, {}, {}, own_range}, format, progress);
  const PlotField field = field_of_map(after, field_edges(2), progress);
  const ColourLimits shared = same_limits(colour_limits(before.values, ColourMap::Diverging), after.values);
  progress.check();
  const HeightMap& of_own = own_range != nullptr ? *own_range : after;
  const ColourLimits own = same_limits(colour_limits(of_own.values, ColourMap::Diverging), after.values);
  return draw_maps(title,
                   {{field, ColourMap::Diverging, shared, "on the range of before", "nm"},
                    {field, ColourMap::Diverging, own, "on its own range", "nm"}},
                   format)
      .bytes;
}

std::string dwell_picture(const ToolPath& path, const std::vector<double>& dwell, const PictureOptions& options,
                          FigureFormat format, const Progress& progress) {
  return picture(field_of_dwell(path, dwell, field_edges(1), progress), dwell, options,
                 options.unit.empty() ? "s" : options.unit, format, progress);
}

}  // namespace dwell

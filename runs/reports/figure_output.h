#pragma once

#include <string>
#include <vector>

#include "runs/base/output_folder.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// Writes a figure into a folder of results, in each of the formats: NAME.png, NAME.svg. `draw` makes
/// the bytes of a format.
template <class Draw>
void write_figure(const OutputFolder& folder, const std::vector<FigureFormat>& formats, const std::string& name,
                  Draw draw) {
  for (const FigureFormat format : formats) {
    folder.write(name + "." + std::string(to_string(format)), draw(format));
  }
}

}  // namespace dwell

#pragma once

#include <string>
#include <vector>

#include "core/formats/map_header.h"

namespace dwell {

/// What a reader found in a file that holds a regular array of heights, before the user's options have a say:
/// read_map (core/formats/map_io.h) applies pitch, origin and unit of options and header, which must agree.
struct MapSource {
  Index rows = 0;
  Index cols = 0;
  std::vector<double> values;  // row-major, row 0 = smallest y, NaN = no data, in header.unit
  double raw_factor = 1.0;     // values are the file's numbers times this: marks for no data are numbers of the file
  MapHeader header;            // what the file says: pitch, origin, unit, history; nothing it leaves open
  std::string pitch_hint;      // ends the message when neither file nor option says a pitch
  std::string pitch_field;     // what of the file says the pitch, with its value, for messages; may be empty
  /// What of the file seems to say an origin, but not clearly: the map is refused unless the option says it.
  std::string unclear_origin;
  /// Where pixel (0, 0) lies on the instrument's camera [pixels], y up: the origin where neither header nor option says
  /// one. Unlike header.origin it gives way to the option, for the camera's coordinates are nobody's part.
  Point camera_pixel;
};

}  // namespace dwell

#pragma once

#include <optional>
#include <string_view>

namespace dwell {

/// What a field of a map file (an attribute, a key, a keyword) speaks of, as far as its name tells.
enum class FieldTopic {
  Other,
  ValueUnit,    // unit of the values: unit, units, z_unit, BUNIT
  LateralUnit,  // unit of x, y and pitch: xy_unit, PIXUNIT
  UnknownUnit,  // a unit of something: foo_unit
  Pitch,        // pitch, pixel_size, dx
  Size,         // of the whole map: width, x_real, diameter
  Origin,       // origin, x_offset, xmin
  NoData,       // no_data, fill_value
  ValueScale,   // what the values are to be multiplied by, or what is added: z_scale, offset
  Label,        // a text for people that may end with a unit: long_name = "height [um]"
};

enum class FieldAxis { Both, X, Y };

struct FieldName {
  FieldTopic topic = FieldTopic::Other;
  FieldAxis axis = FieldAxis::Both;
  std::optional<double> mm;  // the unit of length that the name holds, in mm: pixel_size_um, mm_per_pixel
  /// Whether the name says it without doubt: origin and pitch do; xmin may be the edge of a pixel or its centre,
  /// resolution that of the optics, camera_pixel_size that of the detector.
  bool clear = false;
};

/// Reads a name in any spelling: pixel_size_um, "Pixel size (um)", PixelSizeX, XPIXSZ. Cost O(length of the name).
FieldName parse_field_name(std::string_view name);

}  // namespace dwell

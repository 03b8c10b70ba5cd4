#pragma once

#include <optional>
#include <string_view>

#include "core/formats/map_terms.h"

namespace dwell {

enum class FieldAxis { Both, X, Y };

struct FieldName {
  MapTopic topic = MapTopic::Other;
  FieldAxis axis = FieldAxis::Both;
  std::optional<double> mm;  // the unit of length that the name holds, in mm: pixel_size_um, mm_per_pixel
  /// Whether the name says it without doubt (core/formats/map_terms.h); camera_pixel_size is that of the detector.
  bool clear = false;
  bool middle = false;  // of the map: 0 is no place of its first pixel
  bool values = false;  // it is a word for the values: z, height, surface
  bool place = false;   // it is x or y alone, with a unit or not: the place of a pixel, or coordinates
};

/// Reads a name in any spelling: pixel_size_um, "Pixel size (um)", PixelSizeX, XPIXSZ. Cost O(length of the name).
FieldName parse_field_name(std::string_view name);

}  // namespace dwell

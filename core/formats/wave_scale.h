#pragma once

#include <optional>
#include <string>

#include "core/formats/map_header.h"
#include "core/formats/wave_options.h"
#include "core/map/height_map.h"

namespace dwell {

/// How the values of a file become heights, as far as waves have a say.
struct WaveReading {
  std::optional<double> wave;  // the values are waves of so many nm; nothing: they are in the file's unit of length
  double scale = 1.0;          // what they are multiplied by besides
};

/// Brings together what file and options say of waves; `name` is what messages call the map, `where` begins them. What
/// was done is appended to the header's history, by which a map that is written and read again is known to be one of
/// heights. Throws InputError for values in waves of which wavelength or scale is not said, for options that contradict
/// the file, and for such as have nothing to say of it, as of rates.
WaveReading read_waves(const WaveOptions& options, MapHeader& header, MapQuantity quantity, const std::string& name,
                       const std::string& where);

/// Throws InputError unless wavelength and scale are finite and > 0 where they are given.
void check_wave_options(const WaveOptions& options, const std::string& where);

/// Whether the file itself says how path differences became heights: its format does, or its history.
bool states_wave_scale(const MapHeader& header);

}  // namespace dwell

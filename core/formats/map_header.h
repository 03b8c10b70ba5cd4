#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Something that a file seems to say but not clearly, as a pitch without a unit. It is refused unless the file says it
/// clearly elsewhere or an option of the user does.
struct UnclearStatement {
  enum class About {
    Unit,    // of the values
    Factor,  // of the values: their unit may be said and say nothing of it
    Pitch,
    Places,  // the unit of places: the pitch of a matrix, and of points x and y themselves
    Origin,
    Shift,  // of the map by a length: the places of points say nothing of it
    Rows,   // which way rows and columns run
    Axes,   // which way x and y point, or the part was seen: of points too
    NoData,
    Wavefront,  // the values are a path difference, and a surface is mostly half as high
  };
  About about;
  std::string message;  // where it stands, what it says and how it would be clear
};

/// What a map file says about itself.
struct MapHeader {
  std::optional<Point> pitch;   // in x and y [mm], both > 0
  std::optional<Point> origin;  // centre of pixel (0, 0) [mm]
  std::optional<std::string> unit;
  std::vector<double> no_data;  // values, as the file holds them, that stand for no data
  std::vector<UnclearStatement> unclear;
  bool places_known = false;         // of points: their unit is said
  std::vector<std::string> history;  // how the map was made, a step each, oldest first
  double pitch_rounding = 1e-9;      // relative: how well a pitch that the user gives can agree with the file's
  std::optional<double> wavelength;  // [nm]
  std::optional<double> wave_scale;  // height for each wave, in wavelengths, by which the values are heights already
  bool from_waves = false;           // the file holds waves, and the values are those times the wavelength
  std::string wave_field;            // what says so, for messages
  bool other_is_wavefront = false;   // another array of the file is called a path difference, and this one is not
};

/// pitch_rounding of formats that hold the pitch in single precision.
inline constexpr double kSinglePitchRounding = 1e-6;

/// Takes one comment line (from its '#') as `header_lines` writes them into the header; any other means nothing.
/// `place` begins the message, as in "map a.csv, line 3". Throws InputError for a known key whose value cannot be read
/// or that comes a second time.
void read_header_line(std::string_view line, const std::string& place, MapHeader& header);

/// The comment lines that make a text map of this grid, quantity (in nm or nm/s) and history read back equal.
std::string header_lines(const HeightMap& map);

}  // namespace dwell

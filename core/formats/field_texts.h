#pragma once

#include <optional>
#include <string>

namespace dwell {

// What the text of a field may be: an attribute of HDF5, a key of JSON, a keyword of FITS.

/// The unit of length at the end of a text for people, "height [um]" or "z (mm)"; empty if there is none.
std::string unit_of_label(const std::string& label);

/// A length as text, "0.12 mm", in mm; nothing if it is none.
std::optional<double> length_of_text(const std::string& text);

/// Whether two texts name one unit: "um" and "Micrometres".
bool is_same_unit(const std::string& a, const std::string& b);

/// Seconds, volts and pixels are no unit of heights, whatever they are of.
bool is_unit_of_no_height(const std::string& text);

/// "upper left" is a place, the name of an institution is none.
bool speaks_of_a_place(const std::string& text);

/// "upper left", "top", "lower right": not where the first pixel lies here.
bool names_another_corner(const std::string& text);

}  // namespace dwell

#pragma once

#include <string>
#include <string_view>

namespace dwell {

/// What a name in a map file (a key of a comment, an attribute, a keyword) speaks of.
enum class MapTopic {
  Other,
  ValueUnit,    // unit of the values: unit, units, z_unit, BUNIT
  LateralUnit,  // unit of x, y and pitch: xy_unit, PIXUNIT
  UnknownUnit,  // a unit of something: foo_unit
  Pitch,        // pitch, pixel_size, dx
  Size,         // of the whole map: width, x_real, diameter
  Origin,       // where the map lies: origin, x_offset, xmin, centre, extent
  NoData,       // no_data, fill_value
  ValueScale,   // what the values are to be multiplied by, or what is added, or their sign: z_scale, offset, exponent
  Label,        // a text for people that may end with a unit: long_name = "height [um]"
  Orientation,  // which way rows and columns run: orientation, FLIPY
  AxisOrder,    // which index is which: dims, axes, order
};

/// Whether an attribute, key or keyword of the name says it without doubt: origin and pitch do; xmin may be the edge of
/// a pixel or its centre, resolution that of the optics. What is doubtful is named, not honoured.
enum class InField { Clear, Doubtful };

/// What a comment of the name is worth, where sentences stand too.
enum class InText {
  Sure,      // nothing else has this name: a value that does not fit is refused
  Fits,      // honoured where the value fits, else a comment like any other
  Doubtful,  // a value that fits is unclear: refused unless an option settles it
  Never,     // says nothing there
};

/// A name as programs write it: letters and digits alone, in lower case and as fold_letters gives them, without the x
/// or y of an axis and without a unit. In English, German and French.
struct MapTerm {
  std::string_view word;
  MapTopic topic;
  InField field;
  InText text;
  bool needs_axis = false;  // means it only of an axis: xmin, but not min
};

/// The one table of names, for text and for fields. Nothing if it does not know the word.
const MapTerm* find_map_term(std::string_view word, bool along_axis);

/// The text in lower case, of Russian too, with the letters of German and French as ASCII spells them: "Höhe" ->
/// "hoehe", "unité" -> "unite", in UTF-8 or Latin-1. The signs of micrometre and angstrom stay.
std::string fold_letters(std::string_view text);

/// The text with the sign of multiplication as a letter x between blanks.
std::string with_letter_times(std::string_view text);

/// Whether a folded word speaks of the values of a map: height, surface, error. Not wavefront: what surface makes one
/// depends on the test.
bool is_value_word(std::string_view word);

/// Whether a folded word before "unit" makes it that of the values ("opd_unit"); empty does.
bool is_value_of_unit(std::string_view word);

/// Whether a folded word before "unit" makes it that of x and y ("pixel size unit").
bool is_lateral_of_unit(std::string_view word);

/// "unit", "units", "Einheit", "unités", folded.
bool is_unit_name(std::string_view word);

}  // namespace dwell

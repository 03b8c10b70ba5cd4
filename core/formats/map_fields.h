#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/formats/field_texts.h"
#include "core/formats/map_header.h"

namespace dwell {

/// A field of a file that may speak of its map: an attribute of HDF5, a key of JSON, a keyword of FITS.
struct MapField {
  std::string name;                // as parse_field_name (core/formats/field_name.h) reads it
  std::vector<double> numbers;     // its value: these,
  std::vector<std::string> texts;  // or these
  std::string shown;               // as messages call it, with the file: "attribute pitch of HDF5 data set '/m'"
  std::optional<double> mm;        // the unit that the file gives for this field apart from the name
  bool logical = false;            // the number stands for yes or no
};

/// What fields say of a map.
struct SaidOfMap {
  MapHeader header;            // pitch, origin, unit and markers of no data where they are said without doubt
  std::string pitch_field;     // the field of the pitch with its value, for messages
  std::string unclear_pitch;   // fields that seem to be of pitch or size, but leave open what; empty if none
  std::string unclear_origin;  // the same of the origin
};

/// Reads all fields together, for one may hold the unit of another. What looks like a unit of the values, a factor or a
/// marker of no data is honoured or refused by name, as is what contradicts another field; fields of other topics are
/// skipped. Whoever calls must refuse unclear_origin unless the user says the origin: without it a map begins at
/// (0, 0). unclear_pitch needs no such care, as no map is read without a pitch. Texts that no rule has understood are
/// scanned by the last guard (core/formats/remark_guard.h): what they seem to say is in header.unclear, as are factors
/// of doubtful names and orientations. Throws InputError that begins with `where`.
SaidOfMap read_map_fields(const std::vector<MapField>& fields, const std::string& where);

}  // namespace dwell

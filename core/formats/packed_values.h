#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dwell {

/// A value as stored that stands for no data.
struct NoDataMarker {
  std::string name;  // as the file calls it: _FillValue
  double value = 0.0;
};

/// How an array of a file stands for heights, in the terms of the CF conventions (1.11, sections 2.5.1 and 8.1) and the
/// netCDF User's Guide ("Attribute Conventions").
struct PackedValues {
  double scale = 1.0, offset = 0.0;  // height = stored * scale + offset
  std::vector<NoDataMarker> no_data;
  std::optional<double> least, most;  // stored values beyond are no data,
  bool range_of_heights = false;      // or heights beyond, after scale and offset
  /// Integers of this many bits that were stored without a sign in a type that has one, or (negative) the other way.
  int other_sign_bits = 0;
};

/// Turns stored values into heights, no data into NaN. Returns what was done with counts, for the history of the map;
/// empty if there was nothing to do.
std::string unpack_values(const PackedValues& packing, std::vector<double>& values);

}  // namespace dwell

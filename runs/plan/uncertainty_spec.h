#pragma once

#include <string>
#include <string_view>

namespace dwell {

/// By how much tool, machine and instrument may differ from what is thought of them: standard deviations of normal
/// errors.
struct UncertaintySpec {
  double tif_rate = 0.0;   // of the volume that the tool takes in a second, as a share; the same in all runs
  double tif_width = 0.0;  // of the tool's width, as a share; the same in all runs
  double position = 0.0;   // of every end of a move, in x and in y [mm]
  double offset = 0.0;     // of the whole program on the part, in x and in y [mm]; the same in all runs
  double rotation = 0.0;   // of the program about the middle of the map [degrees]; the same in all runs
  double metrology = 0.0;  // of every pixel of a measurement [nm]
  double drift = 0.0;      // of the rate from run to run, as a share

  friend bool operator==(const UncertaintySpec&, const UncertaintySpec&) = default;
};

/// Reads "tif-rate=15%,tif-width=5%,position=20um,offset=0.3mm,rotation=0.2deg,metrology=0.2nm,drift=2%", some of them
/// in any order. Every number has its unit: %, um or mm, deg or mrad, nm or pm. Throws InputError naming the part, its
/// value and what is accepted.
UncertaintySpec parse_uncertainty_spec(std::string_view text);

/// Text that reads back equal; empty where nothing is uncertain.
std::string to_string(const UncertaintySpec& spec);

}  // namespace dwell

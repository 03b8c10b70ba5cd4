#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/form/form_terms.h"
#include "core/map/height_map.h"

namespace dwell {

/// A quantity of a surface that a specification limits.
enum class SurfaceQuantity {
  Rms,    // [nm]
  Pv,     // [nm]
  Pvr,    // the PV that no single pixel decides [nm]
  Slope,  // RMS, over neighbouring pixels in x and y together [urad]
  Band,   // RMS between two wavelengths [nm]
};

/// One limit of a specification: QUANTITY<=NUMBER[UNIT].
struct SurfaceLimit {
  SurfaceQuantity quantity = SurfaceQuantity::Rms;
  double most = 0.0;                     // [nm]; of slope [urad]
  double shortest = 0.0, longest = 0.0;  // of a band [mm]
  std::string name;                      // as it was written, without its limit: "rms", "band(0.3..3mm)"

  const char* unit() const { return quantity == SurfaceQuantity::Slope ? "urad" : "nm"; }
};

/// Limits from text, separated by commas: "rms<=1, pv<=10nm, pvr<=8, slope<=0.2urad, band(0.3..3mm)<=0.5, mid<=0.5".
/// Bare numbers are nm, of slope urad; units are pm, A, nm, um, mm, and nrad, urad, mrad, arcsec. `mid` is the band
/// between the two wavelengths of `band_edges` [mm, descending], or the one between the two in the middle of four, and
/// so on. Throws InputError naming the text, the part of it and what is accepted: nothing is skipped, and no quantity
/// may be limited twice.
std::vector<SurfaceLimit> parse_surface_limits(std::string_view text, const std::vector<double>& band_edges);

/// The same of an option that is read before the edges of the bands are known; throws for whatever is wrong in the text
/// by itself.
void check_surface_limits(std::string_view text);

/// The edges between the bands that a tool of this FWHM [mm] corrects (waves longer than two of them), hardly reaches,
/// and does not reach but leaves marks in (shorter than half of one) [mm, descending].
std::vector<double> tool_band_edges(double fwhm);

/// The limits as text that parses to the same.
std::string surface_limits_text(const std::vector<SurfaceLimit>& limits);

/// How a surface stands to one limit.
struct SurfaceVerdict {
  SurfaceLimit limit;
  std::optional<double> value;  // nothing where the map does not resolve the band, or has too few pixels
  std::string note;             // why, or which part of a band the map cannot show

  /// A value that is not known does not pass, and neither does NaN.
  bool passes() const { return value && *value <= limit.most; }
  double margin() const { return limit.most - value.value_or(limit.most); }
};

/// Judges a surface less its form terms. Bands are of the areal spectrum with the usual window, the mean, where it
/// counts, taken out, since it would leak through the window. Throws InputError if no
/// pixel is finite, Interrupted. Cost O(pixels), and one transform where a band is limited.
std::vector<SurfaceVerdict> judge_surface(const HeightMap& map, const FormTerms& form,
                                          const std::vector<SurfaceLimit>& limits, int threads = 1,
                                          const Progress& progress = {});

/// Whether all pass; of no limits, yes.
bool all_pass(const std::vector<SurfaceVerdict>& verdicts);

/// The verdicts as lines: quantity, limit, value, margin, pass or FAIL; units in all.
std::string verdict_lines(const std::vector<SurfaceVerdict>& verdicts);

}  // namespace dwell

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/spectra/psd.h"

namespace dwell {

/// A line A f^-B on logarithmic axes, the form in which ISO 10110-8 limits a spectrum: A is the density at 1/mm.
struct PsdLine {
  double a = 0.0;
  double b = 0.0;

  double operator()(double frequency) const;
};

/// "f^-2.1", "f^0.2": the power of frequency of the line, with its sign.
std::string power_of_frequency(const PsdLine& line);

/// The line that a spectrum follows between two frequencies.
struct PsdLineFit {
  PsdLine line;
  double from = 0.0, to = 0.0;  // [1/mm]
  double scatter = 0.0;         // RMS of log10(density / line)
};

/// Least squares of log10 density over log10 frequency, on means over tenths of a decade so that the many high
/// frequencies do not outvote the few low ones. Nothing if fewer than three tenths hold a frequency of positive
/// density.
std::optional<PsdLineFit> fit_psd_line(const PsdCurve& curve, double from, double to);

/// A spectrum held against a line that it should not exceed.
struct PsdLimitCheck {
  Index checked = 0, above = 0;                 // frequencies between `from` and `to`
  double from = 0.0, to = 0.0;                  // [1/mm]
  double worst_factor = 0.0;                    // largest density / line
  double worst_frequency = 0.0;                 // where [1/mm]
  std::vector<std::pair<double, double>> runs;  // frequencies of each run above the line, first and last [1/mm]

  bool met() const { return checked > 0 && above == 0; }
};

PsdLimitCheck check_psd_limit(const PsdCurve& curve, const PsdLine& limit, double from, double to);

/// A limit as a user gives it: "A,B" for the spectra along x and y, "radial:A,B" for the radial one.
struct PsdLimit {
  bool radial = false;
  PsdLine line;
};

/// Throws InputError naming the text and what is accepted: A > 0 and finite, B finite.
PsdLimit parse_psd_limit(const std::string& text);

}  // namespace dwell

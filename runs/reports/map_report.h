#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/form/map_statistics.h"
#include "core/form/polynomial_fit.h"
#include "core/form/robust_pv.h"
#include "core/map/surface_slope.h"
#include "core/spectra/psd_line.h"
#include "core/spectra/wavelength_bands.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/base/input_file.h"
#include "runs/base/json_blocks.h"
#include "runs/drawing/figure_format.h"
#include "runs/reports/map_profile.h"

namespace dwell {

struct MapReportOptions {
  PolynomialSpec removed;              // form that does not count: taken out before anything else
  std::optional<PolynomialSpec> form;  // polynomials to describe the map by, as measured
  bool spectrum = false;
  SpectralWindow window;
  std::vector<double> band_edges{33.0, 0.12};  // [mm]
  std::optional<PsdLimit> limit;
  std::vector<SurfaceLimit> accept;  // that the figure is judged by
  int threads = 1;
};

/// A spectrum, the line it follows, and how it stands to the limit.
struct CurveReport {
  PsdCurve curve;
  std::optional<PsdLineFit> fit;
  std::optional<PsdLimitCheck> limit;  // only of the curves that the limit is for
};

struct SpectrumReport {
  SpectralWindow window;
  double rms = 0.0;                                            // of the map under the window [nm]
  double longest_wavelength = 0.0, shortest_wavelength = 0.0;  // resolved [mm]
  Index bridged = 0;
  bool holes = false;
  std::vector<CurveReport> curves;  // along x, along y, radial
  BandSplit split;
  std::optional<PsdLimit> limit;

  bool limit_met() const;  // also without a limit
};

/// The figures of a map. Heights in nm, slopes in urad.
struct MapReport {
  PolynomialSpec removed;
  PolynomialFit removed_fit;
  HeightMap figure;  // the map without `removed`
  MapStatistics statistics;
  std::optional<RobustPv> robust;  // none of fewer pixels than terms
  SlopeStatistics slope;
  std::optional<PolynomialSpec> form;
  PolynomialFit form_fit;
  MapStatistics form_residual;  // of the map without `form`
  std::optional<SpectrumReport> spectrum;

  std::vector<SurfaceVerdict> acceptance;

  /// A sentence for each limit of `acceptance` that is not met and each spectrum above its limit; not empty = exit
  /// code 3.
  std::vector<std::string> broken_limits() const;
};

/// Lines are fitted and limits checked where both the spectrum is resolved (PsdCurve; fits up to half the Nyquist
/// frequency, where noise and the instrument still matter little) and, with two band edges or more, between the first
/// and the last of them. Throws InputError if the map has no finite pixel, Interrupted.
MapReport map_report(const HeightMap& map, const MapReportOptions& options, const Progress& progress = {});

/// Lines of text, each "name      value unit".
std::string map_report_text(const MapReport& report);

/// The figures of a map that its JSON holds besides the report. `valid_pixels` is the number in the whole map, before
/// the aperture.
MapFigures map_figures(const MapReport& report, const std::string& file, const HeightMap& map, Index valid_pixels,
                       const std::string& aperture);

/// Report and map as JSON text (docs/json.md), units in the keys; with the profile, if there is one.
std::string map_report_json(const MapReport& report, const MapFigures& map, const std::vector<InputFile>& inputs,
                            const MapProfile* profile = nullptr);

/// The spectra as a figure: along x and y at the left, radial at the right, bands shaded, fit and limit. Throws
/// std::invalid_argument without a spectrum.
std::string psd_picture(const MapReport& report, const std::string& title, FigureFormat format = FigureFormat::Png);

}  // namespace dwell

#pragma once

#include <string>

#include "core/base/grid_limit.h"
#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// What the surface is taken to be beyond its edge, at distance d from the nearest pixel with data, of height h.
enum class Extension {
  Zero,       // 0
  Nearest,    // h
  Decay,      // h (1 + cos(pi d / width)) / 2: falls smoothly from h to 0 at the width
  Harmonic,   // Laplace's equation: the data hold their heights, no flux at the outer end (core/numerics/laplace.h)
  Gerchberg,  // waves longer than `shortest` only, fitted to the data by Gerchberg's iteration
};

/// "zero", "nearest", "decay", "harmonic" or "gerchberg". Throws InputError.
Extension parse_extension(const std::string& text);

struct ExtendOptions {
  Extension how = Extension::Nearest;
  double width = 0.0;       // [mm], > 0
  double shortest = 0.0;    // Gerchberg: shortest wavelength [mm], > 0
  int iterations = 200;     // Gerchberg: at most, >= 1
  double tolerance = 1e-4;  // Gerchberg: ends when an iteration changes the extension by less (RMS) than this part of
                            // the RMS of the data about their mean
  PixelLimit limit;         // of the larger map, and of what Gerchberg transforms
};

struct ExtendSummary {
  Index pixels = 0;     // that got a height
  int iterations = 0;   // Gerchberg, Harmonic
  double change = 0.0;  // Gerchberg: of the last iteration, relative as the tolerance
};

/// The map on a grid that is larger by the width on every side (rounded up to whole pixels), with heights in every
/// pixel without data, in holes too, whose centre is at most `width` from the centre of one with data. Pixels with data
/// keep theirs to the last bit. Gerchberg (R. W. Gerchberg 1974, "Super-resolution through error energy reduction",
/// Optica Acta 21, 709; Papoulis 1975): it starts from the nearest height everywhere, then alternately takes out by FFT
/// all waves shorter than `shortest` in any direction and puts the data back. The FFT is periodic; at least `shortest`
/// (at most the map's side) lies between the data and its repetition. It converges fast for long waves only, and leaves
/// a step at the edge where the data has shorter ones. Throws InputError for options out of range or a map without
/// data. Cost O(pixels), Gerchberg two FFTs an iteration.
HeightMap extend_map(const HeightMap& map, const ExtendOptions& options, ExtendSummary& summary, int threads = 1,
                     const Progress& progress = {});

}  // namespace dwell

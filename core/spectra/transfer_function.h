#pragma once

#include <optional>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// How strongly a removal function acts on ripples: modulus of its Fourier transform over that at frequency zero, so 1
/// for long waves. A dwell that varies by a share of its mean with a wavelength makes a ripple of that share times the
/// response.
struct TransferFunction {
  std::vector<double> frequency;  // 0, step, 2 step ... [1/mm], up to half of 1/pitch
  std::vector<double> along_x;    // of waves along x (lines of equal phase along y)
  std::vector<double> along_y;
  std::vector<double> radial;  // mean over all directions
};

/// By zero-padded FFT of the samples (core/numerics/fft.h): the frequency step is at most 1/16 of 1/extent (1/4 for
/// more than 512 samples across), values between the grid's frequencies by bilinear interpolation, the radial mean over
/// 180 directions. Frequencies go to half of 1/(larger pitch). Throws InputError if the samples' sum is not positive.
/// Cost: an FFT of up to 4096 x 4096.
TransferFunction transfer_function(const HeightMap& rates, int threads = 1);

/// The wavelength [mm] down to which the response is at least `share`: from long to short waves, the interpolated one
/// at which it first falls below. Nothing if it never does.
std::optional<double> shortest_wave(const std::vector<double>& frequency, const std::vector<double>& response,
                                    double share);

}  // namespace dwell

#include "core/spectra/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/numerics/fft.h"

namespace dwell {
namespace {

/// The response on the transform's own frequencies, and between them.
class Response {
 public:
  Response(const HeightMap& rates, int threads)
      : rows_(padded_size(rates.grid.rows)),
        cols_(padded_size(rates.grid.cols)),
        step_x_(1.0 / (static_cast<double>(cols_) * rates.grid.pitch_x)),
        step_y_(1.0 / (static_cast<double>(rows_) * rates.grid.pitch_y)) {
    RealFft2D fft(rows_, cols_, threads);
    std::fill(fft.real().begin(), fft.real().end(), 0.0);
    for (Index r = 0; r < rates.grid.rows; ++r) {
      for (Index c = 0; c < rates.grid.cols; ++c) {
        const double v = rates.at(r, c);
        if (std::isfinite(v)) fft.real()[static_cast<std::size_t>(r * cols_ + c)] = v;
      }
    }
    fft.forward();
    const double zero = fft.spectrum()[0].real();
    if (!(zero > 0.0)) {
      throw InputError(fmt::format(
          "removal function: its samples sum to {} nm/s; its transfer function needs a positive sum", zero));
    }
    for (const auto& v : fft.spectrum()) modulus_.push_back(std::abs(v) / zero);
  }

  double step() const { return std::min(step_x_, step_y_); }

  /// At (fx, fy), fx >= 0, both within half of 1/pitch.
  double operator()(double fx, double fy) const {
    const double u = std::min(fx / step_x_, static_cast<double>(cols_ / 2) - 1e-9), v = fy / step_y_;
    const double u0 = std::floor(u), v0 = std::floor(v), a = u - u0, b = v - v0;
    const auto at = [&](double col, double row) {
      const Index c = std::min(static_cast<Index>(col), cols_ / 2);
      const Index r = (static_cast<Index>(row) % rows_ + rows_) % rows_;
      return modulus_[static_cast<std::size_t>(r * (cols_ / 2 + 1) + c)];
    };
    return (1.0 - b) * ((1.0 - a) * at(u0, v0) + a * at(u0 + 1.0, v0)) +
           b * ((1.0 - a) * at(u0, v0 + 1.0) + a * at(u0 + 1.0, v0 + 1.0));
  }

 private:
  static Index padded_size(Index n) { return good_fft_size(n > 512 ? 4 * n : std::max<Index>(16 * n, 64)); }

  Index rows_, cols_;
  double step_x_, step_y_;
  std::vector<double> modulus_;  // rows x (cols / 2 + 1)
};

}  // namespace

TransferFunction transfer_function(const HeightMap& rates, int threads) {
  constexpr int kDirections = 180;
  const Response response(rates, threads);
  const double highest = 0.5 / std::max(rates.grid.pitch_x, rates.grid.pitch_y), step = response.step();
  TransferFunction result;
  for (double k = 0.0; k * step <= highest; ++k) {
    const double f = k * step;
    double sum = 0.0;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = std::numbers::pi * ((d + 0.5) / kDirections - 0.5);
      sum += response(f * std::cos(angle), f * std::sin(angle));
    }
    result.frequency.push_back(f);
    result.along_x.push_back(response(f, 0.0));
    result.along_y.push_back(response(0.0, f));
    result.radial.push_back(sum / kDirections);
  }
  return result;
}

std::optional<double> shortest_wave(const std::vector<double>& frequency, const std::vector<double>& response,
                                    double share) {
  for (std::size_t k = 1; k < frequency.size(); ++k) {
    if (!(response[k] < share)) continue;
    const double part = (response[k - 1] - share) / (response[k - 1] - response[k]);
    return 1.0 / (frequency[k - 1] + part * (frequency[k] - frequency[k - 1]));
  }
  return std::nullopt;
}

}  // namespace dwell

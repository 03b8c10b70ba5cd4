#include "core/numerics/fft.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace dwell {
namespace {

bool has_only_small_factors(Index n) {
  for (Index p = 2; p <= n; ++p) {
    while (n % p == 0) {
      if (p > 7) return false;
      n /= p;
    }
  }
  return true;
}

TEST(GoodFftSize, IsTheSmallestWithSmallFactors) {
  for (Index n = 1; n <= 1500; ++n) {
    Index expected = n;
    while (!has_only_small_factors(expected)) ++expected;
    ASSERT_EQ(good_fft_size(n), expected) << n;
  }
  EXPECT_EQ(good_fft_size(0), 1);
  EXPECT_EQ(good_fft_size(-5), 1);
  EXPECT_EQ(good_fft_size(4097), 4116);  // 2^2 3 7^3
}

std::vector<std::complex<double>> direct_transform(const std::vector<double>& x, Index rows, Index cols) {
  std::vector<std::complex<double>> result;
  for (Index p = 0; p < rows; ++p) {
    for (Index q = 0; q < cols / 2 + 1; ++q) {
      std::complex<double> sum = 0.0;
      for (Index r = 0; r < rows; ++r) {
        for (Index c = 0; c < cols; ++c) {
          const double turns = static_cast<double>((p * r) % rows) / static_cast<double>(rows) +
                               static_cast<double>((q * c) % cols) / static_cast<double>(cols);
          sum += x[static_cast<std::size_t>(r * cols + c)] * std::polar(1.0, -2.0 * std::numbers::pi * turns);
        }
      }
      result.push_back(sum);
    }
  }
  return result;
}

class RealFft2DOf : public testing::TestWithParam<std::tuple<Index, Index, int>> {};

TEST_P(RealFft2DOf, AgreesWithThePlainTransformAndComesBack) {
  const auto [rows, cols, threads] = GetParam();
  RealFft2D fft(rows, cols, threads);
  ASSERT_EQ(fft.rows(), rows);
  ASSERT_EQ(fft.cols(), cols);
  ASSERT_EQ(static_cast<Index>(fft.real().size()), rows * cols);
  ASSERT_EQ(static_cast<Index>(fft.spectrum().size()), rows * (cols / 2 + 1));
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> x(static_cast<std::size_t>(rows * cols));
  double norm = 0.0;
  for (double& v : x) {
    v = normal(random);
    norm += v * v;
  }
  norm = std::sqrt(norm);
  std::copy(x.begin(), x.end(), fft.real().begin());
  fft.forward();
  const auto expected = direct_transform(x, rows, cols);
  for (std::size_t k = 0; k < expected.size(); ++k)
    ASSERT_LE(std::abs(fft.spectrum()[k] - expected[k]), 1e-13 * std::sqrt(static_cast<double>(x.size())) * norm) << k;
  for (std::size_t k = 0; k < x.size(); ++k) ASSERT_EQ(fft.real()[k], x[k]) << "forward keeps real";
  fft.inverse();
  for (std::size_t k = 0; k < x.size(); ++k)
    ASSERT_LE(std::abs(fft.real()[k] - x[k] * static_cast<double>(x.size())),
              1e-13 * norm * static_cast<double>(x.size()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, RealFft2DOf,
                         testing::Combine(testing::Values<Index>(1, 6, 15), testing::Values<Index>(1, 8, 21),
                                          testing::Values(1, 2)));

TEST(RealFft2D, MovesWithItsBuffers) {
  RealFft2D first(4, 4, 1);
  std::fill(first.real().begin(), first.real().end(), 1.0);
  RealFft2D second = std::move(first);
  second.forward();
  EXPECT_EQ(second.spectrum()[0], std::complex<double>(16.0, 0.0));
}

}  // namespace
}  // namespace dwell

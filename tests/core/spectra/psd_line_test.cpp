#include "core/spectra/psd_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

PsdCurve power_law(double a, double b) {
  PsdCurve curve{"x", "nm^2 mm", {}, {}, 0.02, 5.0};
  for (int k = 1; k <= 500; ++k) {
    curve.frequency.push_back(0.01 * k);
    curve.density.push_back(a * std::pow(0.01 * k, -b));
  }
  return curve;
}

TEST(PsdLine, IsFoundWhereThereIsOne) {
  const auto fit = fit_psd_line(power_law(0.3, 1.7), 0.02, 4.0);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->line.b, 1.7, 0.02);  // the mean of a curved law over a tenth of a decade lies above it
  EXPECT_NEAR(fit->line.a, 0.3, 0.01);
  EXPECT_LE(fit->scatter, 0.01);
  EXPECT_NEAR(fit->line(2.0), 0.3 * std::pow(2.0, -1.7), 0.005);
}

TEST(PsdLine, NeedsThreeTenthsOfADecade) {
  EXPECT_FALSE(fit_psd_line(power_law(0.3, 1.7), 1.0, 1.1));
  EXPECT_FALSE(fit_psd_line(power_law(0.3, 1.7), 50.0, 60.0));
  EXPECT_FALSE(fit_psd_line({}, 0.1, 10.0));
  PsdCurve zero = power_law(0.3, 1.7);
  for (double& d : zero.density) d = 0.0;
  EXPECT_FALSE(fit_psd_line(zero, 0.02, 4.0));
}

TEST(PsdLimit, SaysWhereAndByWhatFactorItIsExceeded) {
  PsdCurve curve = power_law(0.3, 1.7);
  for (const std::size_t k : {49u, 50u, 51u, 199u}) curve.density[k] *= 6.0;
  curve.density[50] *= 2.0;
  const PsdLimitCheck check = check_psd_limit(curve, {0.6, 1.7}, 0.1, 3.0);
  EXPECT_FALSE(check.met());
  EXPECT_EQ(check.checked, 291);
  EXPECT_EQ(check.above, 4);
  EXPECT_NEAR(check.worst_factor, 6.0, 1e-9);
  EXPECT_NEAR(check.worst_frequency, 0.51, 1e-12);
  ASSERT_EQ(check.runs.size(), 2u);
  EXPECT_NEAR(check.runs[0].first, 0.50, 1e-12);
  EXPECT_NEAR(check.runs[0].second, 0.52, 1e-12);
  EXPECT_NEAR(check.runs[1].first, 2.00, 1e-12);
  EXPECT_TRUE(check_psd_limit(curve, {0.6, 1.7}, 2.5, 3.0).met());
  EXPECT_FALSE(check_psd_limit(curve, {0.6, 1.7}, 6.0, 7.0).met());  // nothing there to meet it
  curve.density[100] = std::nan("");
  EXPECT_FALSE(check_psd_limit(curve, {0.6, 1.7}, 0.9, 1.2).met());
}

TEST(PsdLine, SaysThePowerWithItsSign) {
  EXPECT_EQ(power_of_frequency({1.0, 2.134}), "f^-2.13");
  EXPECT_EQ(power_of_frequency({1.0, -0.235}), "f^0.235");
  EXPECT_EQ(power_of_frequency({1.0, 0.0}), "f^0");
}

TEST(PsdLimit, TextIsRead) {
  test::expect_input_error([] { parse_psd_limit("radial:1,-2"); },
                           {"radial:1,-2", "a limit that rises", "from 0 to 20"});
  const PsdLimit lines = parse_psd_limit("0.01, 1.55"), radial = parse_psd_limit("radial:2e-3,2.5");
  EXPECT_FALSE(lines.radial);
  EXPECT_EQ(lines.line.a, 0.01);
  EXPECT_EQ(lines.line.b, 1.55);
  EXPECT_TRUE(radial.radial);
  EXPECT_EQ(radial.line.b, 2.5);
  for (const char* text : {"", "1", "1,2,3", "0,1", "-1,2", "nan,2", "1,inf", "x:1,2", "radial:", ":1,2"}) {
    test::expect_input_error([&] { parse_psd_limit(text); }, {text, "radial:A,B"});
  }
}

}  // namespace
}  // namespace dwell

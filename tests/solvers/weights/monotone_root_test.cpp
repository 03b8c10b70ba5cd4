#include "solvers/weights/monotone_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace dwell {
namespace {

struct Trace {
  RootEnd end;
  std::vector<double> x;
};

Trace find(const std::function<double(double)>& f, double close = 1e-3, std::size_t most = 100) {
  Trace trace{};
  MonotoneRoot problem;
  problem.start = 8.0;
  problem.first_step = 2.0;
  problem.ordinary_end = 16.0;
  problem.ceiling = 32.0;
  problem.value = [&](double x) -> std::optional<double> {
    if (trace.x.size() == most) return std::nullopt;
    trace.x.push_back(x);
    const double value = f(x);
    return std::abs(value) <= close ? 0.0 : value;
  };
  trace.end = find_monotone_root(problem);
  return trace;
}

TEST(MonotoneRoot, IsFoundOnBothSidesOfTheStartInFewValues) {
  for (const double root : {0.2, 3.0, 7.9, 8.3, 14.0, 20.0, 31.0}) {
    for (const auto& shape : {std::function<double(double)>([](double d) { return d; }),
                              std::function<double(double)>([](double d) { return std::expm1(0.3 * d); }),
                              std::function<double(double)>([](double d) { return std::tanh(d) + 0.01 * d; })}) {
      const Trace trace = find([&](double x) { return shape(x - root); });
      EXPECT_EQ(trace.end, RootEnd::Found);
      EXPECT_NEAR(trace.x.back(), root, 0.05);
      EXPECT_LE(trace.x.size(), 16u) << root;
    }
  }
}

TEST(MonotoneRoot, EndsAtZeroAndAtTheCeiling) {
  const Trace above = find([](double x) { return x + 1.0; });
  EXPECT_EQ(above.end, RootEnd::AtZero);
  EXPECT_EQ(above.x.back(), 0.0);
  const Trace below = find([](double x) { return x - 40.0; });
  EXPECT_EQ(below.end, RootEnd::AtMost);
  EXPECT_EQ(below.x.back(), 32.0);
}

TEST(MonotoneRoot, GivesUpWhereTheFunctionNoLongerRisesButOnlyBeyondTheOrdinaryEnd) {
  const Trace flat = find([](double) { return -1.0; });
  EXPECT_EQ(flat.end, RootEnd::AtMost);
  EXPECT_GT(flat.x.back(), 16.0);
  EXPECT_LT(flat.x.back(), 32.0);
  const Trace late = find([](double x) { return x < 15.0 ? -1.0 : 3.0 * (x - 15.5); });
  EXPECT_EQ(late.end, RootEnd::Found);
}

TEST(MonotoneRoot, AStepIsNarrowedDownAndNoiseEndsNothing) {
  const Trace step = find([](double x) { return x < 5.3 ? -1.0 : 1e-2; });
  EXPECT_EQ(step.end, RootEnd::Found);
  EXPECT_NEAR(step.x.back(), 5.3, 0.1);
  EXPECT_LE(step.x.size(), 35u);
  int k = 0;
  const Trace noisy = find([&](double x) { return x - 6.0 + (++k % 2 == 0 ? 0.05 : -0.05); });
  EXPECT_EQ(noisy.end, RootEnd::Found);
  EXPECT_NEAR(noisy.x.back(), 6.0, 0.2);
}

TEST(MonotoneRoot, StopsWhereTheValueSaysSo) {
  for (const std::size_t most : {0u, 1u, 4u}) {
    const Trace trace = find([](double x) { return x - 31.0; }, 0.0, most);
    EXPECT_EQ(trace.end, RootEnd::Stopped);
    EXPECT_EQ(trace.x.size(), most);
  }
}

}  // namespace
}  // namespace dwell

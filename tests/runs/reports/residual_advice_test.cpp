#include "runs/reports/residual_advice.h"

#include <gtest/gtest.h>

#include "runs/reports/anatomy_lines.h"

namespace dwell {
namespace {

/// A residual of these shares of the mean square, with a tenth of the area in the zone at the edge.
ResidualAnatomy anatomy(double blemishes, double edge, double shorter, double middle, double longer) {
  ResidualAnatomy a;
  a.fwhm = 4.0;
  a.edge.width = 2.0;
  a.mean_square = {blemishes, edge, shorter, middle, longer};
  a.pixels = 10000;
  a.edge_pixels = 1000;
  a.blemish_pixels = blemishes > 0.0 ? 10 : 0;
  return a;
}

bool says(const ResidualAnatomy& a, const AdviceFacts& facts, const std::string& begins) {
  const std::string advice = residual_advice(a, facts);
  EXPECT_TRUE(advice.starts_with(begins)) << advice;
  return advice.starts_with(begins);
}

TEST(ResidualAdvice, SaysWhatWouldLowerTheMeanSquareMost) {
  EXPECT_TRUE(says(anatomy(82, 6, 11, 1, 0), {}, "mask the blemishes"));
  EXPECT_TRUE(says(anatomy(0, 60, 40, 0, 0), {}, "overrun: the zone at the edge leaves"));
  EXPECT_TRUE(says(anatomy(0, 10, 89, 1, 0), {}, "this tool can go no further: 89 %"));
  EXPECT_TRUE(says(anatomy(0, 10, 50, 30, 10), {.price_cost = 0.0, .smoothness_cost = 0.0}, "a finer path"));
  // What the weights cost is not known: they may be the cause.
  EXPECT_TRUE(says(anatomy(0, 10, 50, 30, 10), {}, "a longer run, less smoothness or a finer path: 40 %"));
  EXPECT_TRUE(says(anatomy(0, 0, 1, 0, 99), {.price_cost = 0.002, .smoothness_cost = 0.9971},
                   "less smoothness: it costs at least 99.7 %"));
  EXPECT_TRUE(says(anatomy(0, 10, 60, 30, 0), {.price_cost = 0.05, .smoothness_cost = 0.3}, "less smoothness"));
  EXPECT_TRUE(says(anatomy(0, 10, 60, 30, 0), {.price_cost = 0.3, .smoothness_cost = 0.1}, "a longer run"));
}

TEST(ResidualAdvice, CountsAtTheEdgeOnlyWhatTheInteriorDoesNotHave) {
  // A zone of a tenth of the area with a tenth of the squares is like the rest of the part.
  EXPECT_TRUE(says(anatomy(0, 11, 89, 0, 0), {}, "this tool can go no further"));
  EXPECT_TRUE(says(anatomy(0, 40, 60, 0, 0), {.overrun = 0.5}, "overrun: "));
  EXPECT_TRUE(says(anatomy(0, 40, 60, 0, 0), {.overrun = 5.0}, "a smaller tool: the zone at the edge"));
}

TEST(ResidualAdvice, ForgetsBlemishesThatAreLeftOut) {
  EXPECT_TRUE(says(anatomy(82, 2, 15, 1, 0), {.blemishes_left_out = true}, "this tool can go no further: 83.3 %"));
}

TEST(ResidualAdvice, KnowsWhatIsLeftOnPurpose) {
  EXPECT_TRUE(says(anatomy(0, 10, 10, 40, 40), {.fraction = 0.8}, "--fraction 1: 20 % of the error"));
  EXPECT_TRUE(says(anatomy(0, 0, 0, 0, 0), {}, "nothing is left"));
}

TEST(AnatomyLines, ListTheBlemishesWithTheMostSquares) {
  ResidualAnatomy a = anatomy(80, 5, 10, 4, 1);
  MapStatistics with;
  with.rms = 10.0;
  for (int k = 0; k < 7; ++k) {
    Blemish b;
    b.place = {1.0 + k, 2.0};
    b.length = 0.8, b.width = 0.5, b.height = -18.8;
    b.pixels = {k};
    a.blemishes.push_back(b);
    a.of_blemish.push_back(k == 0 ? 56.0 : 4.0);
  }
  const std::string text = anatomy_lines(a, with);
  for (const char* words :
       {"80.0 % blemishes", "5.0 % in the zone of 2 mm at the edge (10.0 % of the area)",
        "10.0 % in waves < 4 mm (the FWHM), 4.0 % to 12 mm, 1.0 % longer", "blemishes 7 on 10 pixels",
        "RMS 10 nm with all", "1: at (1, 2) mm, 0.80 x 0.50 mm, -18.8 nm, 56 % of the mean square",
        "and 2 more, 8 % together"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  }
  EXPECT_EQ(text.find("6: at"), std::string::npos);
  const auto block = anatomy_block(a, "a smaller tool");
  EXPECT_EQ(block["blemishes"]["count"], 7);
  EXPECT_EQ(block["blemishes"]["found"].size(), 7u);
  EXPECT_NEAR(block["shares"]["blemishes"].get<double>(), 0.8, 1e-12);
  EXPECT_EQ(block["advice"], "a smaller tool");
  a.searched = false;
  EXPECT_NE(anatomy_lines(a, with).find("blemishes not looked for\n"), std::string::npos);
}

}  // namespace
}  // namespace dwell

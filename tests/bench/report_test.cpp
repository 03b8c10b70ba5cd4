#include "bench/report.h"

#include <gmock/gmock.h>

#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Json whole_run(const std::vector<Json>& runs) {
  Json all = results(runs);
  all["machine"] = {{"processor", "p"}, {"cores", 2},       {"memory_gib", 1.0}, {"compiler", "c"},
                    {"flags", "f"},     {"commit", "none"}, {"fftw", "w"},       {"date", "d"}};
  all["seconds"] = {{"all", 10.0}};
  all["budget"] = 10.0;
  return all;
}

TEST(Report, OpensWithAPictureAndFiveSentences) {
  const std::string text = markdown_report(whole_run({solve("b-512", "auto", 2)}), "picture.png");
  EXPECT_THAT(text, StartsWith("# Benchmarks\n\n![time and quality](picture.png)\n\nThe default solver `auto`"));
  EXPECT_THAT(text, HasSubstr("comes within 1 % of the optimum on 1 of 1 problems"));
  EXPECT_LT(text.find("not measured"), text.find("## Targets"));  // the plans' sentence says so
}

TEST(Report, ShowsWhatWasSkippedAsSuch) {
  Json all = whole_run({solve("b-512", "auto", 2),
                        {{"scenario", "b-512"},
                         {"solver", "lbfgsb"},
                         {"threads", 2},
                         {"rounds", 0},
                         {"skipped", "no time left in the budget"}}});
  all["certificates"] = {{{"scenario", "b-512"}, {"solver", "auto"}, {"tolerance", 1e-3}, {"skipped", "no time left"}}};
  all["plans"] = {{{"name", "p"}, {"what", "w"}, {"threads", 2}, {"skipped", "no time left"}}};
  const std::string text = markdown_report(all, "picture.png");
  EXPECT_THAT(text, HasSubstr("| lbfgsb | 2 | skipped: no time left in the budget |"));
  EXPECT_THAT(text, HasSubstr("skipped: 3 measurements"));
  EXPECT_THAT(text, HasSubstr("| 10 + 15 = 25 (20) |"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(Report, SaysOfAPeerThatItWasNotThere) {
  Json peer = never(solve("b-512", "lbfgsb", 2), "time limit");
  peer["max_seconds"] = 24.0;
  peer["times_given"] = 12.0;
  const std::string text = markdown_report(whole_run({solve("b-512", "auto", 2), peer}), "");
  EXPECT_THAT(text, HasSubstr("| lbfgsb | 2 | > 24 | not there at 12 x | > 24 |"));
  EXPECT_THAT(text, HasSubstr("| not there at 12 x |  | > 12 | > 12 |"));
}

TEST(Report, SaysOfAPeerWhoseMatrixDoesNotFitHowLargeItIs) {
  const Json peer{{"scenario", "b-512"},
                  {"solver", "ceres"},
                  {"threads", 2},
                  {"rounds", 1},
                  {"too_large", "too large: takes at most 5000 dwell points; its matrix of 9 x 8 numbers takes 3 GiB"}};
  const std::string text = markdown_report(whole_run({solve("b-512", "auto", 2), peer}), "");
  EXPECT_THAT(text, HasSubstr("| ceres | 2 | too large: takes at most 5000 dwell points; its matrix"));
  EXPECT_THAT(text, HasSubstr("| too large |  |"));
}

TEST(Report, ShowsTheFieldsMethodBesideAuto) {
  Json all = whole_run({solve("b-512", "auto", 2)});
  all["field"] = {{{"scenario", "b-512"},
                   {"seconds", 0.5},
                   {"gamma", 0.03},
                   {"iterations", 2},
                   {"before_rms", 100.0},
                   {"residual_rms", 0.3},
                   {"total_dwell", 900.0}},
                  {{"scenario", "d-512"}, {"skipped", "no Python"}}};
  const std::string text = markdown_report(all, "");
  EXPECT_THAT(text, HasSubstr("| b-512 | 100 | 0.3 | 900 | 0.5 | 0.15 | 400 | 4 |"));
  EXPECT_THAT(text, HasSubstr("| d-512 | skipped: no Python | | | | not run | | |"));
}

TEST(Report, GivesTheMeasuredMirrorBothWays) {
  Json all = whole_run({solve("b-512", "auto", 2)});
  Json plan{{"name", "udo-default"},
            {"what", "w"},
            {"threads", 2},
            {"points", 2678},
            {"seconds", 0.5},
            {"cpu_seconds", 0.7},
            {"peak_memory", 1e8},
            {"solver_seconds", 0.2},
            {"residual_rms", 0.1397},
            {"total_dwell", 415.5},
            {"step_rms", 0.003},
            {"status", "settled"},
            {"without_blemishes", 0.0615}};
  Json published = plan;
  published["name"] = "udo-published-moving";
  published["without_blemishes"] = nullptr;
  published.erase("solver_seconds");
  all["plans"] = {plan, published};
  const std::string text = markdown_report(all, "");
  EXPECT_THAT(text, HasSubstr("| w | 0.1397 | 0.0615 | 415.5 |"));
  EXPECT_THAT(text, HasSubstr("| w | 0.1397 | none found | 415.5 |"));
  EXPECT_THAT(text, HasSubstr("leaves 0.1397 nm RMS (0.0615 nm without blemishes) in 415.5 s"));
}

}  // namespace
}  // namespace dwell::bench

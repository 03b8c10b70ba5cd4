#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>

#include "bench/child.h"
#include "bench/scratch_folder.h"
#include "bench/script_problem.h"
#include "bench/script_solve.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::HasSubstr;

/// A small part without any symmetry on pixels that are not square; the tool halts on pixels, or runs through between
/// them.
Scenario small_scenario(bool moving) {
  Scenario s;
  s.name = "small";
  s.make = [moving] {
    Parts parts;
    parts.map = HeightMap(Grid{17, 23, 0.4, 0.5, {1.0, -2.0}});
    const Grid& grid = parts.map.grid;
    for (Index r = 0; r < grid.rows; ++r) {
      for (Index c = 0; c < grid.cols; ++c) {
        const auto u = static_cast<double>(c), v = static_cast<double>(r);
        parts.map.at(r, c) = 20.0 * std::sin(0.3 * u + 0.1 * v) + 0.5 * u * v - 8.0 * std::cos(0.4 * v);
      }
    }
    parts.map.at(0, 0) = parts.map.at(16, 3) = std::nan("");
    parts.tif = gaussian_removal(2.0, 2.2, 3.0);
    for (Index r = -2; r < grid.rows + 2; r += 2) {
      for (Index k = -2; k < grid.cols + 2; k += 3) {
        const Index c = (r / 2) % 2 == 0 ? k : grid.cols - 1 - k;
        const double shift = moving ? 0.13 : 0.0;
        parts.path.points.push_back(
            {1.0 + 0.4 * (static_cast<double>(c) + shift), -2.0 + 0.5 * static_cast<double>(r)});
      }
    }
    parts.path.lifted.assign(parts.path.points.size(), 0);
    parts.moving = moving;
    parts.least = 0.02;
    return parts;
  };
  return s;
}

constexpr ScenarioWeights kWeights{0.05, 1e-3};

/// An answer in the files that a script writes.
class ScriptAnswer : public testing::Test {
 protected:
  ScriptAnswer() : instance_(make_instance(small_scenario(true), 1)) {
    set_weights(instance_, kWeights);
    dwell_ = Vector::Constant(instance_.problem.points(), 0.5);
    options_.target = Target{objective() / 1.005, 1.0, 1.0};
    write();
  }

  double objective() const { return certify(instance_.problem, dwell_).objective; }
  void write(double said_over_true = 1.0) {
    HeightMap row(Grid{1, dwell_.size(), 1.0, 1.0, {}});
    std::copy(dwell_.begin(), dwell_.end(), row.values.begin());
    write_whole_file(folder_.path() / "answer.npy", npy_bytes(row));
    HeightMap trace(Grid{2, 4, 1.0, 1.0, {}});
    trace.values = {0.1, 1.05 * objective(), 1.2, 4.0, 0.7, said_over_true * objective(), 1.005, 9.0};
    write_whole_file(folder_.path() / "trace.npy", npy_bytes(trace));
    write_whole_file(folder_.path() / "end.json",
                     R"({"status": "target reached", "message": "m", "seconds": 0.8, "applications": 10})");
  }
  /// What it is refused for; empty if it is not.
  std::string refusal() {
    try {
      result_ = {};
      read_script_answer(folder_.path(), instance_.problem, options_, result_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  ScratchFolder folder_;
  Instance instance_;
  Vector dwell_;
  SolveOptions options_;
  Json result_;
};

TEST_F(ScriptAnswer, IsReadWithItsTimes) {
  ASSERT_EQ(refusal(), "");
  const Json& reached = result_.at("reached").at("objective");
  EXPECT_EQ(reached.at(0).at("seconds"), 0.1);  // 5.5 % above the target's objective
  EXPECT_EQ(reached.at(1).at("seconds"), 0.7);  // 0.5 %
  EXPECT_EQ(reached.at(1).at("applications"), 9.0);
  EXPECT_TRUE(reached.at(2).is_null());
  EXPECT_TRUE(result_.at("reached").at("residual").at(0).is_object());
  EXPECT_EQ(result_.at("reached").at("residual").at(1).at("seconds"), 0.7);
  EXPECT_EQ(result_.at("status"), "target reached");
  EXPECT_NEAR(result_.at("certificate").at("objective").get<double>(), objective(), 1e-9 * objective());
}

TEST_F(ScriptAnswer, ThatIsNotWhatItSaysIsRefused) {
  write(0.99);
  EXPECT_THAT(refusal(), HasSubstr("the script says an objective of"));
}

TEST_F(ScriptAnswer, OfAnotherSizeIsRefused) {
  dwell_.conservativeResize(dwell_.size() - 1);
  HeightMap row(Grid{1, dwell_.size(), 1.0, 1.0, {}});
  write_whole_file(folder_.path() / "answer.npy", npy_bytes(row));
  EXPECT_THAT(refusal(), HasSubstr("answer.npy: 1 x"));
}

TEST_F(ScriptAnswer, WithNanOrBelowTheLeastDwellIsRefused) {
  dwell_[3] = std::nan("");
  HeightMap row(Grid{1, dwell_.size(), 1.0, 1.0, {}});
  std::copy(dwell_.begin(), dwell_.end(), row.values.begin());
  write_whole_file(folder_.path() / "answer.npy", npy_bytes(row));
  EXPECT_THAT(refusal(), HasSubstr("row 1, column 4 is not finite"));
  row.values[3] = 0.01;
  write_whole_file(folder_.path() / "answer.npy", npy_bytes(row));
  EXPECT_THAT(refusal(), HasSubstr("a dwell below the least"));
}

TEST_F(ScriptAnswer, WithoutAWholeEndIsRefused) {
  for (const char* bad : {"", "{", "[]", R"({"status": "x"})",
                          R"({"status": "x", "message": "m", "seconds": null, "applications": 1})"}) {
    write_whole_file(folder_.path() / "end.json", bad);
    EXPECT_THAT(refusal(), HasSubstr("end.json")) << bad;
  }
}

/// Runs a script on a small problem; its answer, or nothing where there is no SciPy.
std::optional<Json> answer_of(const std::string& solver, bool moving, double max_seconds, double stop_gap) {
  if (why_no_scripts()) return std::nullopt;
  SolveOptions options;
  options.weights = kWeights;
  options.stop_at_target = true;
  options.stop_gap = stop_gap;
  options.max_seconds = max_seconds;
  Instance instance = make_instance(small_scenario(moving), 1);
  set_weights(instance, kWeights);
  SolverOptions exact;
  exact.kind = SolverKind::DenseNnls;
  Vector t;
  make_solver(exact)->solve(instance.problem, t);
  const Certificate c = certify(instance.problem, t);
  options.target = Target{c.objective, c.residual_rms, t.sum()};
  Json run = solve_by_script(small_scenario(moving), find_bench_solver(solver), options);
  run["optimum"] = c.objective;
  return run;
}

/// Every script puts the operator together by itself, and refuses to run if it is not the program's: so an answer
/// proves that the arrays say what they should, for halts on pixels and for strokes between them.
TEST(Scripts, ComeToTheOptimumOfTheDenseSolver) {
  for (const bool moving : {false, true}) {
    for (const char* solver : {"scipy-nnls", "scipy-lbfgsb"}) {
      const std::optional<Json> run = answer_of(solver, moving, 60.0, 1e-7);
      if (!run) GTEST_SKIP() << *why_no_scripts();
      ASSERT_TRUE(run->contains("certificate")) << solver << ": " << run->dump();
      const double objective = run->at("certificate").at("objective"), optimum = run->at("optimum");
      EXPECT_NEAR(objective, optimum, 1e-6 * optimum) << solver << (moving ? ", moving" : ", halting");
      EXPECT_FALSE(run->at("reached").at("objective").at(1).is_null()) << solver;
    }
  }
}

TEST(Scripts, RowsForSumsOfSquaresHoldThePriceToo) {
  const std::optional<Json> run = answer_of("scipy-lsq-linear", true, 60.0, 5e-3);
  if (!run) GTEST_SKIP() << *why_no_scripts();
  ASSERT_TRUE(run->contains("certificate")) << run->dump();
  const double objective = run->at("certificate").at("objective"), optimum = run->at("optimum");
  EXPECT_NEAR(objective, optimum, 1e-2 * optimum);
}

}  // namespace
}  // namespace dwell::bench

/// A run as a shop does it, on disk: the steps, what is learnt from one to the next, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/map/map_turn.h"
#include "core/numerics/plane_transform.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_kernel.h"
#include "core/tif/scaled_removal.h"
#include "runs/figure/store/measured_step.h"
#include "runs/figure/store/measured_text.h"
#include "runs/figure/store/new_run.h"
#include "runs/figure/store/plan_step.h"
#include "runs/figure/store/run_status.h"
#include "runs/figure/store/withdrawn_step.h"
#include "runs/plan/moved_program.h"
#include "runs/programs/program_reader.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

/// An elliptic part in waves that the tool reaches, on pixels that are not square; without symmetry.
HeightMap part_map() {
  HeightMap map(Grid{24, 34, 1.5, 1.6, {-25.0, -18.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const bool outside = p.x * p.x / 560.0 + p.y * p.y / 280.0 > 1.0;
    map.values[static_cast<std::size_t>(i)] =
        outside ? std::nan("")
                : 90.0 * std::cos(p.x / 5.0 + 0.3) + 70.0 * std::sin(p.y / 4.0 + p.x / 9.0) + 0.2 * p.x * p.y;
  }
  return map;
}

/// A shop whose tool and machine are other than it thinks.
struct Shop {
  test::TemporaryFolder folder;
  HeightMap surface = part_map();
  double rate = 1.2, width = 0.95;
  PlaneTransform misplaced = similarity({3.0, -1.0}, {0.31, -0.24}, 0.25, 1.0);

  fs::path run_folder() const { return folder.path() / "run"; }

  MadeRun begin(const std::string& target = "", JobOptions options = {}) const {
    write_map(folder.path() / "first.npy", surface);
    options.map = (folder.path() / "first.npy").string();
    options.tif = "gaussian:peak=15,fwhm=7,radius=10";
    options.path = parse_path_spec("raster:pitch=2,overrun=6");
    options.threads = 1;
    return make_run(run_folder(), {options, target, ""});
  }

  PlannedStep plan() const {
    RunFolder run(run_folder());
    const FigureState state = figure_state(run);
    return add_plan(run, state, state.options);
  }

  /// Runs the program of a plan: where the machine is told to go is not where it removes.
  void polish(const PlannedStep& step) {
    Program program = read_program(fs::path(step.folder) / "program.nc");
    const ProgramFrame frame = program.frame;  // what the machine sees are the program's own coordinates
    const auto commanded = [&](Point p) { return frame.to_program(p); };
    for (ProgramStep& move : program.steps) move.start = commanded(move.start), move.finish = commanded(move.finish);
    const RemovalFunction tool = scaled_removal(gaussian_removal(15.0, 7.0, 10.0), rate, width);
    const RemovalKernel kernel = pixel_kernel(tool, surface.grid.pitch_x, surface.grid.pitch_y);
    surface = surface_after(surface, simulate(moved_program(program, misplaced), surface, kernel, 1));
  }

  MeasuredStep measure(const HeightMap& map, Measurement measurement = {}) const {
    const fs::path file = folder.path() / "next.npy";
    write_map(file, map);
    RunFolder run(run_folder());
    const FigureState state = figure_state(run);
    measurement.map = state.conventions;
    measurement.map.map = file.string();
    return add_measurement(run, state, measurement);
  }

  FigureState state() const { return figure_state(RunFolder(run_folder())); }
  double rms() const { return map_statistics(surface, {true, true}).rms_about_zero(); }
};

TEST(FigureRun, LearnsFromItsFirstMeasurementAndKeepsEveryStep) {
  Shop shop;
  shop.begin();
  shop.polish(shop.plan());
  const double after_first = shop.rms();
  EXPECT_GT(after_first, 10.0);
  const MeasuredStep first = shop.measure(shop.surface);
  EXPECT_EQ(first.fault, "");
  EXPECT_NEAR(first.lesson.rate, 1.2, 0.005);
  EXPECT_NEAR(first.lesson.width, 0.95, 0.003);
  EXPECT_NEAR(first.after.rms_about_zero(), after_first, 1e-9);
  EXPECT_GT(first.comparison.split.tool, 5.0);
  EXPECT_GT(first.comparison.split.position, 1.0);
  EXPECT_LT(first.comparison.split.unexplained, 0.5);
  EXPECT_NE(first.next_run.advice.find("another run pays"), std::string::npos) << first.next_run.advice;
  const FigureState learnt = shop.state();
  EXPECT_EQ(learnt.runs, 1);
  EXPECT_NEAR(learnt.options.tif_rate, 1.2, 0.005);
  // Told the places of the new frame, the machine removes where it is meant to.
  const Point p{11.0, -7.0};
  const ProgramFrame frame(learnt.options.zero_mm, learnt.options.rotate_deg, false);
  EXPECT_NEAR(distance(shop.misplaced(frame.to_program(p)), p), 0.0, 0.02);
  shop.polish(shop.plan());
  EXPECT_LT(shop.rms(), 1.0);
  const MeasuredStep second = shop.measure(shop.surface);
  EXPECT_NEAR(second.lesson.rate, 1.0, 0.01);
  EXPECT_EQ(second.iteration, 2);
  EXPECT_NEAR(second.predicted.rms_about_zero(), second.after.rms_about_zero(), 0.5);
  const RunFolder run(shop.run_folder());
  EXPECT_EQ(run.faults(), std::vector<std::string>{});
  EXPECT_EQ(run.steps().size(), 5U);
  const std::string table = status_text(run);
  EXPECT_NE(table.find("measured 2"), std::string::npos) << table;
  EXPECT_NE(measured_text(second, 7.0).find("split     tool"), std::string::npos);
}

TEST(FigureRun, IsTheSameWhereverItsFolderIs) {
  Shop shop;
  shop.begin();
  shop.polish(shop.plan());
  shop.measure(shop.surface);
  const std::string before = read_whole_file(fs::path(shop.plan().folder) / "program.nc");
  fs::rename(shop.run_folder(), shop.folder.path() / "elsewhere");
  fs::remove(shop.folder.path() / "first.npy");  // the run has its own
  fs::remove(shop.folder.path() / "next.npy");
  RunFolder run(shop.folder.path() / "elsewhere");
  const FigureState state = figure_state(run);
  const PlannedStep again = add_plan(run, state, state.options);
  const auto moves = [](const std::string& program) { return program.substr(program.find("\nG")); };
  EXPECT_EQ(moves(read_whole_file(fs::path(again.folder) / "program.nc")), moves(before));
  EXPECT_EQ(RunFolder(run.folder()).faults(), std::vector<std::string>{});
}

TEST(FigureRun, TakesBackAMeasurement) {
  Shop shop;
  shop.begin();
  shop.polish(shop.plan());
  shop.measure(shop.surface);
  shop.plan();  // from the map that is taken back
  {
    RunFolder run(shop.run_folder());
    EXPECT_THROW(withdraw_measurement(run, figure_state(run), 2, ""), InputError);  // a plan
    withdraw_measurement(run, figure_state(run), 3, "dust on the reference");
    EXPECT_THROW(withdraw_measurement(run, figure_state(run), 3, ""), InputError);  // is so already
  }
  const FigureState state = shop.state();
  EXPECT_EQ(state.runs, 0);
  EXPECT_EQ(state.plan_step, 2);
  EXPECT_EQ(state.options.tif_rate, 1.0);
  EXPECT_EQ(shop.measure(shop.surface).iteration, 1);  // the right one
  EXPECT_NEAR(shop.state().options.tif_rate, 1.2, 0.005);
}

TEST(FigureRun, KeepsNothingOfAMapThatLiesOtherwise) {
  Shop shop;
  shop.begin();
  shop.polish(shop.plan());
  const HeightMap flipped = turn_map(shop.surface, GridTurn::FlipX);
  const MeasuredStep wrong = shop.measure(flipped);
  EXPECT_NE(wrong.fault.find("the map after the run lies otherwise"), std::string::npos) << wrong.fault;
  EXPECT_EQ(RunFolder(shop.run_folder()).steps().size(), 2U);
  Measurement righted;
  righted.steps_of_this_map = "flip:x";
  EXPECT_EQ(shop.measure(flipped, righted).fault, "");
  EXPECT_EQ(shop.state().conventions.map_steps, "");  // of this map alone
  EXPECT_EQ(shop.state().options.map_steps, "flip:axis=x");
}

TEST(FigureRun, TakesALargeShiftForAnErrorUnlessItIsAnswered) {
  Shop shop;
  shop.misplaced = similarity({}, {2.6, 0.0}, 0.0, 1.0);
  shop.begin();
  shop.polish(shop.plan());
  const MeasuredStep wrong = shop.measure(shop.surface);
  EXPECT_NE(wrong.fault.find("orientation or origin"), std::string::npos) << wrong.fault;
  Measurement known;
  known.policy.taken = {LessonSubject::Shift};
  const MeasuredStep taken = shop.measure(shop.surface, known);
  EXPECT_EQ(taken.fault, "");
  EXPECT_NEAR(taken.lesson.shift.x, 2.6, 0.05);
  shop.polish(shop.plan());
  EXPECT_LT(shop.rms(), 1.5);
}

TEST(FigureRun, PlansTheShortestRunThatMeetsItsTarget) {
  Shop shop;
  shop.rate = 1.0, shop.width = 1.0, shop.misplaced = {};
  shop.begin("rms<=6nm");
  const PlannedStep loose = shop.plan();
  EXPECT_TRUE(loose.target.reaches) << loose.target.sentence;
  EXPECT_LE(loose.written.exact.statistics.rms_about_zero(), 6.0);
  EXPECT_GT(loose.written.exact.statistics.rms_about_zero(), 3.0);
  fs::rename(shop.run_folder(), shop.folder.path() / "loose");
  shop.begin();
  const double usual_s = shop.plan().target.plan.dwell.run_dwell();
  EXPECT_LT(loose.target.plan.dwell.run_dwell(), 0.97 * usual_s);
  fs::rename(shop.run_folder(), shop.folder.path() / "usual");
  shop.begin("rms<=1pm");
  const PlannedStep usual = shop.plan();
  EXPECT_FALSE(usual.target.reaches);
  EXPECT_NE(usual.target.sentence.find("not reached"), std::string::npos) << usual.target.sentence;
  EXPECT_DOUBLE_EQ(usual.target.plan.dwell.run_dwell(), usual_s);
}

TEST(FigureRun, LeavesAMarginForWhatIsUncertain) {
  Shop shop;
  shop.begin("rms<=3nm");
  shop.polish(shop.plan());
  shop.measure(shop.surface);
  RunFolder run(shop.run_folder());
  FigureState state = figure_state(run);
  EXPECT_TRUE(state.uncertainty().any());
  const PlannedStep sure = add_plan(run, state, state.options);
  LessonDecision& rate = state.lessons.back().decisions[0];
  rate.found.error = 0.05;
  const PlannedStep unsure = add_plan(run, state, state.options);
  EXPECT_GT(unsure.target.expected.margin, sure.target.expected.margin + 0.5);
  // By hand: two standard deviations of 5 % of the removal.
  EXPECT_GT(unsure.target.plan.dwell.run_dwell(), sure.target.plan.dwell.run_dwell());
}

TEST(FigureRun, RefusesWhatItCannotDo) {
  Shop shop;
  EXPECT_THROW(shop.begin("rms<=1furlong"), InputError);
  JobOptions priced;
  priced.time_price_nm2_per_s = {1e-3, GoalKind::Fixed};
  EXPECT_THROW(shop.begin("rms<=1nm", priced), InputError);
  EXPECT_FALSE(fs::exists(shop.run_folder()));
  shop.begin();
  EXPECT_THROW(shop.measure(shop.surface), InputError);  // nothing is planned
  const PlannedStep plan = shop.plan();
  HeightMap far = shop.surface;
  far.grid.origin = {500.0, 500.0};
  EXPECT_THROW(shop.measure(far), InputError);
  const std::string program = (fs::path(plan.folder) / "program.nc").string();
  const std::string text = read_whole_file(program);
  std::ofstream(program) << text << "\n(changed)\n";
  EXPECT_THROW(shop.measure(shop.surface), InputError);
  EXPECT_EQ(RunFolder(shop.run_folder()).steps().size(), 2U);
}

}  // namespace
}  // namespace dwell

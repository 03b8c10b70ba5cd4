#include "runs/job/job_file.h"

#include <gtest/gtest.h>

#include "core/tif/models/removal_models.h"
#include "runs/job/place_option.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::TemporaryFolder;

JobOptions read(const TemporaryFolder& folder, const std::string& text, JobOptions options = {}) {
  read_job_file(folder.file("job.toml", text), options);
  return options;
}

/// Every option away from its default; the file names absolute.
JobOptions unusual() {
  JobOptions o;
  o.map = "/data/a map \"of\" C:\\parts.csv";
  o.map_pixel_mm = Point{0.1, 1.0 / 3.0};
  o.map_unit = "um";
  o.tools = "a;tif=/data/spot.csv;price=2\nb;path=raster:pitch=1;change-over=90s";
  o.wavelength_nm = 632.8;
  o.wave_scale = 0.5;
  o.map_origin_mm = Point{-12.5, 1.0 / 3.0};
  o.map_no_data = NoDataMarkers{{-9999.0, 0.1}};
  o.map_max_pv_mm = 25.0;
  o.map_table = parse_matrix_table("um");
  o.map_rows = MapRows::Top;
  o.map_grid = ScatterOptions{0.3, 1.0 / 7.0};
  o.map_steps = "crop:data; subtract:file=/data/b.csv,how=resample";
  o.line_profile = "/data/nom.dat";
  o.profile_columns = "x,slope";
  o.profile_unit = "mm,-urad";
  o.profile_remove = "ellipse:p=7500,q=2500,angle=0.6";
  o.line_width_mm = 12.5;
  o.max_pixels = 1e6;
  o.tif = "gaussian:peak=1,fwhm=2.8,radius=5";
  o.tif_pixel_mm = square_pitch(0.2);
  o.tif_unit = "um/min";
  o.tif_no_data = NoDataMarkers{};
  o.tif_table = parse_matrix_table("index");
  o.tif_rows = MapRows::Bottom;
  o.tif_grid = ScatterOptions{0.2, {}};
  o.tif_steps = "fill:how=harmonic; subtract:file=/data/dark.csv,how=resample";
  o.tif_pedestal = TifPedestal::Taper;
  o.tif_dwell_time_s = 4.5;
  o.tif_centre = parse_tif_centre("0.5,-0.25");
  o.tif_angle_deg = -37.5;
  o.tif_flip = ToolOrientation::Flip::Y;
  o.tif_rate = 1.131;
  o.tif_width = 0.97;
  o.path = parse_path_spec("nearest:cell=2,critical=-inf");
  o.keep_out = "circle:1,2,0.5;file:/data/zones.txt";
  o.motion = Motion::Stop;
  o.remove = {true, true, true};
  o.aperture = parse_aperture("rect:0,0,1,2");
  o.removal = "/data/depth.csv";
  o.piston_nm = -12.5;
  o.clear_aperture = parse_aperture("circle:1,2,3");
  o.weight = "/data/w.npy;centre=2";
  o.objective = {0.25};
  o.uncertainty = parse_sampled_uncertainty("tif-rate=5%,position=20um,rotation=0.1deg,samples=50,seed=7");
  o.robust_plan = true;
  o.fraction = 0.8;
  o.accept = "rms<=1, mid<=0.5nm";
  o.min_dwell_s = 1.0 / 7.0;
  o.max_feed_mm_per_min = 1e7;
  o.machine = "/data/machine.toml";
  o.rounds = 7;
  o.schedule = ScheduleKind::Pvt;
  o.log = "/data/run.csv";
  o.log_plan = "/data/plan";
  o.log_columns = "Time:ms,PosX:um,PosY:um";
  o.log_period_s = 0.002;
  o.log_tolerance_mm = 0.25;
  o.smoothness = {1e-9};
  o.time_price_nm2_per_s = {1.0 / 3.0, GoalKind::TotalAtMost};
  o.solver = SolverKind::DenseNnls;
  o.time_worth = {0.25, 0.125};
  o.certify = 0.0125;
  o.blemishes = BlemishHandling::LeaveOut;
  o.max_solve_s = 12.5;
  o.threads = 2;
  o.gcode = GcodeDialect::G93PerMinute;
  o.lift_height_mm = 3.0;
  o.exports = {"pvt-csv", "pmac"};
  o.program_template = "/data/shop.toml";
  o.path_mode = parse_path_mode("blend:0.05");
  o.header = "/data/start.nc";
  o.footer = "/data/end.nc";
  o.block_numbers = 5;
  o.max_lines = 5000;
  o.zero_mm = {12.5, -1.0 / 3.0};
  o.rotate_deg = 37.5;
  o.swap_axes = true;
  o.inches = true;
  o.figures = {FigureFormat::Svg, FigureFormat::Pdf};
  o.figure_range = FigureRange::Own;
  o.out = "/tmp/plan";
  return o;
}

TEST(JobFile, TakesNoModelOfARemovalFunctionForAFile) {
  const TemporaryFolder folder;
  for (const RemovalModel& model : removal_models()) {
    const std::string formula = model.name + ":radius=5";
    EXPECT_EQ(read(folder, "tif = '" + formula + "'\n").tif, formula);
  }
  EXPECT_EQ(read(folder, "tif = 'mrf.csv'\n").tif, (folder.path() / "mrf.csv").string());
}

TEST(JobFile, WrittenTextReadsBackEqualForEveryOption) {
  const TemporaryFolder folder;
  const JobOptions written = unusual(), defaults;
  const JobOptions back = read(folder, job_file_text(written));
  for (const JobOptionRecord& record : job_option_table()) {
    EXPECT_NE(record.get(written), record.get(defaults)) << record.key << " is not tested";
    EXPECT_EQ(record.get(back), record.get(written)) << record.key;
  }
}

TEST(JobFile, WrittenDefaultsReadBackAsDefaultsWithAllOptionsExplained) {
  const TemporaryFolder folder;
  const JobOptions defaults;
  const std::string text = job_file_text(defaults);
  const JobOptions back = read(folder, text);
  for (const JobOptionRecord& record : job_option_table()) {
    EXPECT_EQ(record.get(back), record.get(defaults)) << record.key;
    EXPECT_NE(text.find("# " + record.help), std::string::npos) << record.key;
    EXPECT_NE(text.find(record.key + " ="), std::string::npos) << record.key;
  }
}

TEST(JobFile, TakesTheFieldsOfAMachine) {
  const TemporaryFolder folder;
  const std::string fields =
      "out = 'o'\n[machine]\nname = 'of the job'\npath_acceleration_mm_per_s2 = 50\n[machine.x]\nletter = 'U'\n";
  const JobOptions options = read(folder, fields);
  EXPECT_EQ(options.machine, "{ name = \"of the job\", path_acceleration_mm_per_s2 = 50, x = { letter = \"U\" } }");
  EXPECT_EQ(read(folder, job_file_text(options)).machine, options.machine);
  expect_input_error([&] { read(folder, "[machine]\n\nmax_feed = 3\n"); },
                     {"job.toml: machine: line 3: max_feed: unknown field; accepted: "});
  expect_input_error([&] { read(folder, "machine = 'm.toml'\n[machine]\nmax_feed_mm_per_min = 3\n"); },
                     {"job.toml", "line 2", "machine"});
}

TEST(JobFile, ComesOverTheOptionsItIsReadInto) {
  const TemporaryFolder folder;
  JobOptions before;
  before.smoothness = {0.5};
  before.min_dwell_s = 0.25;
  const JobOptions after = read(folder, "smoothness = 0.75\n", before);
  EXPECT_EQ(after.smoothness, WeightGoal{0.75});
  EXPECT_EQ(after.min_dwell_s, 0.25);
}

TEST(JobFile, TakesOnePitchAsANumberAndTwoInQuotes) {
  const TemporaryFolder folder;
  EXPECT_EQ(read(folder, "map_pixel_mm = 0.5\n").map_pixel_mm, (Point{0.5, 0.5}));
  EXPECT_EQ(read(folder, "map_pixel_mm = '0.5,0.25'\n").map_pixel_mm, (Point{0.5, 0.25}));
  EXPECT_EQ(read(folder, "tif_pixel_mm = '0.125, 0.2'\n").tif_pixel_mm, (Point{0.125, 0.2}));
  expect_input_error([&] { read(folder, "map_pixel_mm = '1,5'\n"); },
                     {"job.toml: map_pixel_mm", "'1,5'", "decimal comma", "1.5 mm", "1.0,5.0"});
  for (const std::string wrong : {"'0.5,0.25,0.1'", "'0.5,'", "'0.5,-0.25'", "'0.5;0.25'", "'0.5,2e4'"}) {
    expect_input_error([&] { read(folder, "map_pixel_mm = " + wrong + "\n"); },
                       {"job.toml: map_pixel_mm", "required a number from 1e-06", "X,Y"});
  }
}

TEST(JobFile, TakesWordsWhereAWeightIsLeftOpen) {
  const TemporaryFolder folder;
  const JobOptions o = read(folder, "smoothness = 'step RMS <= 0.004 s'\ntime_price_nm2_per_s = 'auto'\n");
  EXPECT_EQ(o.smoothness, (WeightGoal{0.004, GoalKind::StepAtMost}));
  EXPECT_EQ(o.time_price_nm2_per_s, (WeightGoal{0.0, GoalKind::Auto}));
  const JobOptions back = read(folder, job_file_text(o));
  EXPECT_EQ(back.smoothness, o.smoothness);
  EXPECT_EQ(back.time_price_nm2_per_s, o.time_price_nm2_per_s);
  expect_input_error([&] { read(folder, "smoothness = 'total<=3'\n"); },
                     {"job.toml: smoothness", "'total<=3'", "step<=S", "residual<=NM"});
  expect_input_error([&] { read(folder, "min_dwell_s = 'auto'\n"); }, {"job.toml: min_dwell_s", "without quotes"});
}

TEST(JobFile, SaysThatAutoHasAnotherMeaningThanInLayout1) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read(folder, "schema = 2\nsmoothness = 'auto'\n").notes.empty());
  EXPECT_TRUE(read(folder, "smoothness = 0.1\nfigures = 'png'\n").notes.empty());
  const JobOptions old = read(folder, "smoothness = 'auto'\ntime_price_nm2_per_s = ' AUTO'\n");
  ASSERT_EQ(old.notes.size(), 2u);
  EXPECT_NE(old.notes[0].find("job.toml: smoothness = \"auto\""), std::string::npos);
  EXPECT_NE(old.notes[1].find("job.toml: time_price_nm2_per_s"), std::string::npos);
  EXPECT_NE(old.notes[1].find("\"corner\""), std::string::npos);
}

TEST(JobFile, TakesStepsAsOneStringOrAsAList) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "ref.csv").string();
  const std::string expected = "crop:data; subtract:file=" + file + "; fill";
  EXPECT_EQ(read(folder, "map_steps = 'crop:data; subtract:ref.csv ;fill'\n").map_steps, expected);
  EXPECT_EQ(read(folder, "map_steps = ['crop:data', 'subtract:ref.csv', 'fill']\n").map_steps, expected);
  expect_input_error([&] { read(folder, "map_steps = ['crop:data', 3]\n"); },
                     {"job.toml: map_steps", "a list of strings"});
  expect_input_error([&] { read(folder, "map_steps = 'crip:data'\n"); },
                     {"job.toml: map_steps", "unknown step 'crip'", "crop, keep"});
  expect_input_error([&] { read(folder, "map = ['a.csv']\n"); }, {"job.toml: map", "a string (in quotes)"});
}

TEST(JobFile, TakesWholeAndRealNumbers) {
  const TemporaryFolder folder;
  const JobOptions o =
      read(folder, "max_feed_mm_per_min = 3_000\nmin_dwell_s = 1e-1\nthreads = 2.0\nmap_origin_mm = '-1,2.5'\n");
  EXPECT_EQ(o.max_feed_mm_per_min, 3000.0);
  EXPECT_EQ(o.min_dwell_s, 0.1);
  EXPECT_EQ(o.threads, 2);
  ASSERT_TRUE(o.map_origin_mm.has_value());
  EXPECT_EQ(o.map_origin_mm->x, -1.0);
  EXPECT_EQ(o.map_origin_mm->y, 2.5);
}

TEST(JobFile, FileNamesAreRelativeToItsFolder) {
  const TemporaryFolder folder;
  const JobOptions o = read(folder, "map = 'maps/a.csv'\ntif = '../tif.csv'\npath = 'file:p.csv'\nout = 'plan'\n");
  EXPECT_EQ(o.map, (folder.path() / "maps/a.csv").string());
  EXPECT_EQ(o.tif, (folder.path().parent_path() / "tif.csv").string());
  EXPECT_EQ(to_string(o.path), "file:" + (folder.path() / "p.csv").string());
  EXPECT_EQ(o.out, (folder.path() / "plan").string());
  const JobOptions absolute = read(folder,
                                   "map = '/maps/a.csv'\ntif = 'disc:slope=1,radius=2'\n"
                                   "path = 'raster:pitch=1'\n");
  EXPECT_EQ(absolute.map, "/maps/a.csv");
  EXPECT_EQ(absolute.tif, "disc:slope=1,radius=2");
  EXPECT_EQ(to_string(absolute.path), "raster:pitch=1");
}

TEST(JobFile, RefusesAnUnknownFieldAndListsTheKnownOnes) {
  const TemporaryFolder folder;
  expect_input_error([&] { read(folder, "max_feed = 3000\n"); },
                     {"job.toml", "unknown field 'max_feed'", "max_feed_mm_per_min", "map_pixel_mm"});
  expect_input_error([&] { read(folder, "[map]\nfile = 'a.csv'\n"); }, {"job.toml", "map", "table", "string"});
}

TEST(JobFile, RefusesTheWrongType) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& line, std::initializer_list<std::string> words) {
    expect_input_error([&] { read(folder, line + "\n"); }, words);
  };
  refused("smoothness = '0.1'", {"job.toml: smoothness", "0.1", "string", "required a number"});
  refused("smoothness = true", {"job.toml: smoothness", "boolean", "required a number"});
  refused("map_origin_mm = [1, 2]", {"job.toml: map_origin_mm", "array", "required a string"});
  refused("threads = 2024-01-01", {"job.toml: threads", "date", "required a number"});
  refused("map = 5", {"job.toml: map", "5", "required a string"});
}

TEST(JobFile, RefusesValuesAsTheCommandLineDoes) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& line, std::initializer_list<std::string> words) {
    expect_input_error([&] { read(folder, line + "\n"); }, words);
  };
  refused("smoothness = nan", {"job.toml: smoothness", "nan", "required a number from 0 to"});
  refused("max_feed_mm_per_min = inf", {"job.toml: max_feed_mm_per_min", "inf", "required a number from"});
  refused("threads = 2.5", {"job.toml: threads", "2.5", "whole number"});
  refused("map_pixel_mm = -0.5", {"job.toml: map_pixel_mm", "-0.5", "required a number from"});
  refused("map = ''", {"job.toml: map", "empty"});
  refused("out = ''", {"job.toml: out", "empty"});
  refused("path = 'file:'", {"job.toml: path", "name of a file"});
}

TEST(JobFile, NamesTheLineThatIsNotToml) {
  const TemporaryFolder folder;
  expect_input_error([&] { read(folder, "smoothness = 0.1\nmin_dwell_s =\n"); }, {"job.toml: line 2"});
  expect_input_error([&] { read(folder, "smoothness = 1\nsmoothness = 2\n"); }, {"job.toml: line 2"});
  JobOptions options;
  expect_input_error([&] { read_job_file(folder.path() / "none.toml", options); }, {"none.toml", "No such file"});
}

TEST(JobFile, SaysItsLayoutAndReadsThatOfVersion01) {
  const TemporaryFolder folder;
  EXPECT_NE(job_file_text({}).find("\nschema = 2\n"), std::string::npos);
  for (const char* schema : {"", "schema = 1\n", "schema = 2\n"}) {
    EXPECT_EQ(read(folder, std::string(schema) + "min_dwell_s = 0.25\n").min_dwell_s, 0.25) << schema;
  }
}

TEST(JobFile, RefusesALayoutThatItDoesNotKnow) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* line, const char* value) {
    // The layout is looked at first: a field of a later layout is not what is wrong.
    expect_input_error([&] { read(folder, std::string("of_a_later_layout = 1\n") + line); },
                       {"job.toml: schema: ", value, "accepted: 1 (the layout of dwell 0.1) or 2"});
  };
  refused("schema = 3\n", "3");
  refused("schema = 0\n", "0");
  refused("schema = '2'\n", "'2'");
  refused("schema = 2.5\n", "2.5");
  refused("schema = [2]\n", "no number");
}

}  // namespace
}  // namespace dwell

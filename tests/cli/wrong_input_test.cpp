/// Every wrong input ends with exit code 2 and a message that names the thing and what is accepted; nothing is left
/// behind.

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

std::set<std::string> everything_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) names.insert(entry.path().string());
  return names;
}

struct Wrong {
  const char* name;
  std::function<void(const SmallInputs&)> prepare;
  std::vector<std::string> options;  // after those of a good plan, the last one given counts
  std::vector<std::string> words;    // of the message
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

std::function<void(const SmallInputs&)> file(const std::string& name, const std::string& bytes) {
  return [name, bytes](const SmallInputs& inputs) { inputs.folder.file(name, bytes); };
}

/// The first `share` of a good file.
std::function<void(const SmallInputs&)> cut(const std::string& name, const std::string& as, double share) {
  return [name, as, share](const SmallInputs& inputs) {
    const std::string whole = read_whole_file(inputs / name);
    inputs.folder.file(as, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
  };
}

void truncated_npy(const SmallInputs& inputs) {
  write_map(inputs / "whole.npy", HeightMap(Grid{4, 5, 0.5, 0.5, {}}, std::vector<double>(20, 1.0)));
  cut("whole.npy", "bad.npy", 0.9)(inputs);
}

const std::vector<Wrong>& cases() {
  const auto none = [](const SmallInputs&) {};
  const std::string far = "x_mm,y_mm\n500,500\n501,500\n502,500\n";
  static const std::vector<Wrong> kCases{
      {"truncated_map", cut("map.csv", "bad.csv", 0.503), {"--map", "bad.csv"}, {"bad.csv", "line 12", "column"}},
      {"truncated_npy", truncated_npy, {"--map", "bad.npy"}, {"bad.npy", "bytes"}},
      {"empty_map", file("bad.csv", ""), {"--map", "bad.csv"}, {"bad.csv", "empty"}},
      {"ragged_map", file("bad.csv", "1,2,3\n1,2\n"), {"--map", "bad.csv"}, {"bad.csv", "line 2", "2 columns"}},
      {"png_as_map",
       file("bad.csv", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)),
       {"--map", "bad.csv"},
       {"bad.csv", "PNG", "matrix"}},
      {"text_as_map",
       file("bad.csv", "Dear Sir,\nthe mirror is fine.\n"),
       {"--map", "bad.csv"},
       {"bad.csv", "line 1", "number"}},
      {"infinite_height", file("bad.csv", "1,2\ninf,4\n"), {"--map", "bad.csv"}, {"bad.csv", "line 2", "infinite"}},
      {"all_nan_map", file("bad.csv", "nan,nan\nnan,nan\n"), {"--map", "bad.csv"}, {"bad.csv", "no data", "finite"}},
      {"mark_for_no_data",
       file("bad.csv", "-9999,-9999,3,4,2,5\n-9999,7,3.5,1,2,6\n-9999,5,1.5,3,4,6\n"),
       {"--map", "bad.csv"},
       {"bad.csv", "4 pixels are -9999", "--map-no-data -9999", "--map-no-data none"}},
      {"heights_of_a_mountain",
       file("bad.csv", "1,2\n3,4e7\n"),
       {"--map", "bad.csv"},
       {"bad.csv", "40 mm", "at most 10 mm", "--map-max-pv", "--map-no-data"}},
      {"index_column",
       file("bad.csv", ",0,1,2\n0,4,9,2\n1,3,5,8\n2,7,7,1\n"),
       {"--map", "bad.csv"},
       {"bad.csv", "first row", "first column", "--map-table index"}},
      {"pitch_without_a_unit",
       file("bad.csv", "# origin: 3,4\n1,2\n3,5\n"),
       {"--map", "bad.csv"},
       {"bad.csv, line 1", "origin", "'3,4'", "--map-origin"}},
      {"scattered_points",
       file("bad.xyz",
            "0.2 7.1 1\n5.3 0.4 2\n2.2 3.3 3\n9.1 8.8 1\n7.7 2.6 4\n1.4 9.9 2\n3.1 6.0 5\n8.2 5.5 1\n4.6 4.8 2\n"),
       {"--map", "bad.xyz", "--map-pixel", "0.1"},
       {"bad.xyz", "9 points fill", "--map-grid"}},
      {"missing_map", none, {"--map", "absent.csv"}, {"absent.csv", "No such file"}},
      {"folder_as_map", none, {"--map", "."}, {"'.'", "directory", "file is required"}},
      {"other_pitch_than_the_header",
       file("bad.csv", "# pitch_mm: 0.25\n1,2\n3,4\n"),
       {"--map", "bad.csv"},
       {"bad.csv", "0.25", "--map-pixel", "0.5", "agree"}},
      {"tif_larger_than_map",
       none,
       {"--tif", "gaussian:peak=1,fwhm=60,radius=90"},
       {"60 mm", "3 times the map", "15 x 11 mm"}},
      {"tif_file_larger_than_map", none, {"--tif-pixel", "20"}, {"FWHM of", "3 times the map", "--tif-pixel"}},
      {"tif_that_is_a_map", none, {"--tif", "map.csv"}, {"map.csv", "rim of the file", "--tif-pedestal"}},
      {"zero_tif", file("bad.csv", "0,0,0\n0,0,0\n0,0,0\n"), {"--tif", "bad.csv"}, {"bad.csv", "0 nm/s", "> 0"}},
      {"negative_tif", file("bad.csv", "-1,-1\n-1,-2\n"), {"--tif", "bad.csv"}, {"bad.csv", "-1 nm/s", "> 0"}},
      {"all_nan_tif", file("bad.csv", "nan,nan\n"), {"--tif", "bad.csv"}, {"tif", "bad.csv", "no data"}},
      {"missing_tif", none, {"--tif", "absent.csv"}, {"absent.csv", "No such file"}},
      {"narrow_tif", none, {"--tif", "gaussian:peak=1,fwhm=0.3"}, {"removal function", "0.3", "pixel"}},
      {"unknown_tif_key", none, {"--tif", "gaussian:peak=1,width=2"}, {"width", "fwhm"}},
      {"negative_pitch", none, {"--map-pixel", "-0.5"}, {"--map-pixel", "-0.5", "from 1e-06"}},
      {"nan_pitch", none, {"--map-pixel", "nan"}, {"--map-pixel", "nan", "from 1e-06"}},
      {"nan_option", none, {"--smoothness", "nan"}, {"--smoothness", "nan", "from 0"}},
      {"total_for_smoothness",
       none,
       {"--smoothness", "total<=3"},
       {"--smoothness", "'total<=3'", "step<=S", "residual<=NM"}},
      {"step_for_time_price", none, {"--time-price", "step<=3"}, {"--time-price", "'step<=3'", "total<=S", "auto"}},
      {"target_without_number", none, {"--smoothness", "step<="}, {"--smoothness", "'step<='", "S > 0"}},
      {"two_residual_targets",
       none,
       {"--smoothness", "residual<=2", "--time-price", "residual<=1"},
       {"'residual<=2'", "'residual<=1'", "required for one of them"}},
      {"negative_origin_without_y", none, {"--map-origin", "-5"}, {"--map-origin", "-5", "X,Y"}},
      {"unknown_unit", none, {"--map-unit", "furlong"}, {"--map-unit", "furlong", "nm, um, mm, m"}},
      {"unknown_option", none, {"--max-fed", "1"}, {"dwell: unknown option --max-fed", "'dwell plan --help'"}},
      {"unknown_word", none, {"--gcode", "g92"}, {"--gcode", "g92", "g94"}},
      {"empty_value", none, {"--tif-centre", ""}, {"--tif-centre", "empty"}},
      {"path_outside_the_part",
       file("path.csv", far),
       {"--path", "file:path.csv"},
       {"path.csv", "wholly outside", "500 to 502", "map's coordinates"}},
      {"path_point_far_off",
       file("path.csv", "x_mm,y_mm\n5,5\n1e9,5\n6,5\n"),
       {"--path", "file:path.csv"},
       {"path.csv: dwell point 2 = (1e+09, 5) mm is 1e+09 mm from the map", "x 0 to 14.5 and y 0 to 10.5 mm"}},
      {"path_point_farther_off",
       file("path.csv", "x_mm,y_mm\n5,5\n5,-1e15\n6,5\n"),
       {"--path", "file:path.csv"},
       {"path.csv: dwell point 2 = (5, -1e+15) mm is 1e+15 mm from the map"}},
      {"endless_dwell", none, {"--min-dwell", "1e300"}, {"--min-dwell", "'1e300'", "from 0 to 1e+07 (s)"}},
      {"endless_feed", none, {"--max-feed", "1e-9"}, {"--max-feed", "'1e-9'", "from 0.01 to 1e+07 (mm/min)"}},
      {"endless_rate",
       none,
       {"--tif", "gaussian:peak=1e300,fwhm=2"},
       {"peak = \"1e300\"", "required a number from 1e-09 to 1e+09 (nm/s)"}},
      {"large_rate", none, {"--tif", "gaussian:peak=1e10,fwhm=2"}, {"peak = \"1e10\"", "from 1e-09 to 1e+09"}},
      {"out_in_an_earlier_result",
       [](const SmallInputs& inputs) {
         std::filesystem::create_directory(inputs / "p");
         inputs.folder.file("p/summary.json", "{}");
       },
       {"--out", "p/inner"},
       {"--out", "'p/inner' lies in '", "/p', which holds an earlier plan", "outside of it"}},
      {"missing_path_file", none, {"--path", "file:absent.csv"}, {"absent.csv", "No such file"}},
      {"path_file_without_columns",
       file("path.csv", "1,2\n3,4\n"),
       {"--path", "file:path.csv"},
       {"path.csv", "x_mm", "y_mm"}},
      {"unknown_path", none, {"--path", "zigzag:pitch=1"}, {"--path", "zigzag", "raster", "nearest"}},
      {"raster_without_pitch", none, {"--path", "raster:step=1"}, {"--path", "pitch"}},
      {"negative_raster_pitch", none, {"--path", "raster:pitch=-1"}, {"pitch", "-1", "> 0"}},
      {"aperture_outside_the_map", none, {"--aperture", "circle:100,100,3"}, {"aperture", "100", "mm"}},
      {"clear_aperture_outside_the_map",
       none,
       {"--clear-aperture", "circle:100,100,3"},
       {"--clear-aperture", "circle:100,100,3", "no pixel"}},
      {"weight_of_another_grid",
       file("w.csv", "1,1\n1,1\n"),
       {"--weight", "w.csv"},
       {"--weight w.csv", "2 rows x 2 columns", "map.csv"}},
      {"half_a_weight", none, {"--weight", "edge:width=3"}, {"--weight", "edge:width=3", "weight"}},
      {"missing_weight", none, {"--weight", "absent.npy"}, {"--weight", "absent.npy", "edge:width=MM"}},
      {"unknown_objective", none, {"--objective", "slopes"}, {"--objective", "slopes", "height, slope or mixed:SHARE"}},
      {"height_target_beside_slopes",
       none,
       {"--objective", "slope", "--time-price", "residual<=1"},
       {"--time-price 'residual<=1'", "--objective is slope"}},
      {"unwritable_out_below_a_file", none, {"--out", "map.csv/plan"}, {"--out", "map.csv/plan", "Not a directory"}},
      {"unwritable_out", none, {"--out", "/proc/dwell-plan"}, {"--out", "/proc/dwell-plan", "cannot write"}},
      {"file_as_out", none, {"--out", "map.csv"}, {"--out", "map.csv", "folder"}},
      {"folder_of_others_as_out", none, {"--out", "."}, {"--out", "'.'", "not an earlier plan"}},
      {"unknown_job_field",
       file("job.toml", "max_feed = 3\n"),
       {"--job", "job.toml"},
       {"job.toml", "unknown field 'max_feed'", "max_feed_mm_per_min"}},
      {"broken_job", file("job.toml", "smoothness = \n"), {"--job", "job.toml"}, {"job.toml", "line 1"}},
      {"missing_job", none, {"--job", "absent.toml"}, {"absent.toml", "No such file"}},
      {"too_many_points_for_dense",
       none,
       {"--solver", "dense-nnls", "--path", "raster:pitch=0.2"},
       {"dense-nnls", "points", "projected-cg"}},
  };
  return kCases;
}

class WrongInput : public testing::TestWithParam<Wrong> {};

TEST_P(WrongInput, IsRefusedNamedAndLeavesNothingBehind) {
  const SmallInputs inputs;
  const Wrong& wrong = GetParam();
  wrong.prepare(inputs);
  const auto before = everything_in(inputs.folder.path());
  const ProgramResult result = inputs.run(SmallInputs::plan(wrong.options));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  for (const std::string& word : wrong.words) expect_has(result.err, word);
  EXPECT_EQ(everything_in(inputs.folder.path()), before);
  RecordProperty("message", result.err);
}

INSTANTIATE_TEST_SUITE_P(Plan, WrongInput, testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(WrongInputWithoutOption, NamesTheOptionThatIsMissing) {
  const SmallInputs inputs;
  const auto before = everything_in(inputs.folder.path());
  const auto refused = [&](const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const ProgramResult result = inputs.run(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& word : words) expect_has(result.err, word);
  };
  refused({"plan"}, {"--out", "required"});
  refused({"plan", "--out", "plan"}, {"--map", "required"});
  const std::vector<std::string> others{"--tif", "tif.csv", "--path", "raster:pitch=1"};
  refused(test::with({"plan", "--out", "plan", "--map", "map.csv"}, others),
          {"map.csv", "no pixel pitch", "--map-pixel"});
  refused({"plan", "--out", "plan", "--map", "map.csv", "--map-pixel", "0.5"}, {"--tif", "required"});
  refused(test::with({"plan", "--out", "plan", "--map", "map.csv", "--map-pixel", "0.5"}, others),
          {"tif.csv", "no pixel pitch", "--tif-pixel"});
  refused({"plan", "--out", "plan", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "gaussian:peak=1,fwhm=2"},
          {"--path", "required"});
  refused({"pareto"}, {"--map, --tif, --path, --out: required"});
  refused({"pareto", "--out", "sweep"}, {"--map", "required"});
  refused({"simulate"}, {"--program", "required"});
  refused({"map"}, {"file", "required"});
  refused({"map", "map.csv", "--map-pixel", "0.5", "--write", "a.tiff"}, {"a.tiff", ".csv", ".npy"});
  refused({"map", "map.csv", "tif.csv"}, {"argument 'tif.csv' was not expected", "'dwell map --help'"});
  refused({"plam"}, {"command 'plam' was not expected", "'dwell --help'"});
  refused({"example"}, {"--out", "required"});
  EXPECT_EQ(everything_in(inputs.folder.path()), before);
}

TEST(WrongProgram, IsRefusedBySimulate) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  cut("plan/feed.csv", "feed.csv", 0.7)(inputs);
  cut("plan/program.nc", "program.nc", 0.7)(inputs);
  inputs.folder.file("empty.nc", "");
  const auto before = everything_in(inputs.folder.path());
  for (const auto& [program, word] : {std::pair{"feed.csv", "line"},
                                      {"program.nc", "M2"},
                                      {"empty.nc", "empty"},
                                      {"absent.nc", "No such file"},
                                      {"map.csv", "G-code"}}) {
    const ProgramResult result = inputs.run({"simulate", "--program", program, "--map", "map.csv", "--map-pixel", "0.5",
                                             "--tif", "tif.csv", "--tif-pixel", "0.5", "--residual", "left.npy"});
    EXPECT_EQ(result.exit_code, 2) << program;
    expect_has(result.err, program);
    expect_has(result.err, word);
  }
  EXPECT_EQ(everything_in(inputs.folder.path()), before);
}

TEST(WrongWords, AreAnsweredWithTheOptionAndAllThatIsMissing) {
  const test::SmallInputs inputs;
  inputs.folder.file("point.csv", "x_mm,y_mm\n5,5\n");
  const struct {
    std::vector<std::string> words;
    const char* said;
  } kCases[] = {
      {{"plan", "--map", "map.csv"}, "--tif, --path, --out, --map-pixel: required"},
      {{"plan", "--map", "map.csv", "--tif", "tif.csv", "--path", "raster:pitch=1"},
       "--out, --map-pixel, --tif-pixel: required"},
      {{"plan", "--map", "map.csv", "--tif", "tif.csv", "--path", "raster:pitch=1", "--out", "o"},
       "--map-pixel, --tif-pixel: required [mm] > 0; there is no pixel pitch in the map map.csv, nor in the removal "
       "function tif.csv"},
      {{"plan", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv", "--path", "raster:pitch=1", "--out", "o"},
       "tif tif.csv: the file says no pixel pitch; give --tif-pixel"},
      {{"plan", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "gaussian:peak=1,fwhm=2,radius=3", "--tif-pixel",
        "0.5", "--path", "raster:pitch=1", "--out", "o"},
       "--tif-pixel 0.5: for a file of rates, not for the formula gaussian"},
      {{"tif", "gaussian:peak=1,fwhm=2,radius=3", "--tif-unit", "um/s"},
       "--tif-unit um/s: for a file of rates, not for the formula gaussian"},
      {{"plan", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "gaussian:peak=1,fwhm=2,radius=3", "--path",
        "raster:pitch=1", "--out", "o", "--time-price", "0.1", "--time-worth", "0.5"},
       "--time-worth 0.5,0.1 rules the price where that is auto; --time-price is 0.1: leave one of them out"},
      {{"paths", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "gaussian:peak=1,fwhm=2,radius=3", "--paths",
        "raster", "--out", "o", "--time-price", "0.1", "--time-worth", "0.5"},
       "--time-worth 0.5,0.1 rules the price where that is auto"},
      {{"plan", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "gaussian:peak=1,fwhm=2,radius=3", "--path",
        "file:point.csv", "--out", "o", "--min-dwell", "0", "--time-price", "1e12", "--smoothness", "0"},
       "dwell: the plan stays at 1 dwell point for no time: its program would hold no move and no halt"},
      {{"simulate", "--program", "x.nc", "--map", "map.csv"}, "--tif, --map-pixel: required"},
      {{"tif", "--spot", "map.csv"}, "--map-pixel, --dwell-time: required"},
      {{"tif", "--trench", "map.csv"}, "--map-pixel, --feed: required"},
      {{"tif", "--spot", "map.csv", "--map-pixel", "0.5"}, "--dwell-time: required"},
      {{"tif", "--spot", "map.csv", "--dwell-time", "5"}, "the file says no pixel pitch; give --map-pixel"},
      {{"paths", "--paths", "raster"}, "--map, --tif, --out: required"},
      {{"paths"}, "--map, --tif, --out, --paths: required"},
      {{"paths", "--pitch", "abc"}, "--pitch: 'abc'; required a number from 1e-06 to 10000 (mm)"},
      {{"tif", "--trench", "x.csv", "--feed", "abc"}, "--feed: 'abc'; required a number from 0.01 to 1e+07 (mm/min)"},
      {{"tif", "--spot", "x.csv", "--noise-cut", "2"}, "--noise-cut: '2'; required a number from 0 to 0.5"},
      {{"map", "map.csv", "--map-pixel", "0.5", "--bands", "q"}, "--bands: bands \"q\"; accepted"},
      {{"map", "map.csv", "--map-pixel", "0.5", "--form", "q"}, "--form: form \"q\": unknown"},
      {{"simulate", "--program", "x.nc", "--g4", "q"}, "--g4: "},
      {{"example", "--out", "e", "--seed", "1.5"}, "--seed: '1.5'; required a whole number from 0 to 2^53"},
      {{"example", "--out", "e", "--width", "1e"}, "--width: '1e'; required a number from 1e-06 to 1e+06 (mm)"},
      {{"simulate", "--program", "x.nc"}, "--map, --tif: required"},
      {{"example", "--out", "e", "--hole", "500"}, "--hole = 500 mm; required from 0 to the width"},
      {{"example", "--out", "e", "--height", "50"}, "--height 50: of a rectangle only"},
      {{"example", "--out", "e", "--pitch", "90"}, "--pitch = 90 mm; required such that both edges"},
      {{"map", "map.csv", "--map-pixel", "0.5", "--limit", "radial:1,-2"}, "a limit that rises"},
      {{"map", "map.csv", "--map-pixel", "0.5", "--map-unit", "um/s"}, "--map-unit: 'um/s' is a rate, not a height"},
      {{"tif", "tif.csv", "--tif-pixel", "0.5", "--tif-unit", "um"}, "--tif-unit: 'um' is a height, not a rate"},
  };
  for (const auto& [words, said] : kCases) {
    const test::ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << words.back();
    test::expect_has(result.err, said);
  }
}

}  // namespace
}  // namespace dwell

#include "core/formats/npy_sidecar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

HeightMap asymmetric(double first) {
  HeightMap map(Grid{2, 3, 0.1, 0.25, {-1.7, 0.3}}, {first, 2, NAN, 4, 5, 6});
  map.history = {"read part.dat", "crop \"x\": \xc3\xa9"};
  return map;
}

TEST(NpySidecar, GivesTheArrayItsPitchOriginAndHistory) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.npy";
  write_map(file, asymmetric(1));
  EXPECT_EQ(folder.entries(), 2u);
  const HeightMap read = read_map(file);
  test::expect_same_map(read, asymmetric(1));
  EXPECT_EQ(read.history, asymmetric(1).history);
  const std::string text = read_whole_file(npy_sidecar_name(file));
  EXPECT_EQ(text.find("previous"), std::string::npos);
  EXPECT_NE(text.find(sha256_of_file(file)), std::string::npos);
}

TEST(NpySidecar, OptionsMustAgree) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.npy";
  write_map(file, asymmetric(1));
  MapReadOptions options;
  options.pitch = square_pitch(0.1);
  test::expect_input_error([&] { read_map(file, options); }, {"a.npy", "0.1,0.25", "`map pixel`"});
  options = {};
  options.origin = Point{-1.7, 0.4};
  test::expect_input_error([&] { read_map(file, options); }, {"a.npy", "-1.7,0.3", "`map origin`"});
  options.origin = Point{-1.7, 0.3};
  test::expect_same_map(read_map(file, options), asymmetric(1));
}

TEST(NpySidecar, IsRefusedWhenTheArrayIsAnother) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.npy";
  write_map(file, asymmetric(1));
  write_whole_file(file, npy_bytes(asymmetric(2)));
  test::expect_input_error([&] { read_map(file); }, {"a.npy.json", "stale", sha256_of_file(file)});
}

TEST(NpySidecar, AnInterruptedReplacementReadsAsBeforeOrAfter) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.npy";
  HeightMap before = asymmetric(1), after = asymmetric(2);
  after.grid.pitch_x = 0.125;
  write_map(file, before);
  const std::string old_npy = read_whole_file(file), old_json = read_whole_file(npy_sidecar_name(file));
  write_map(file, after);
  const std::string new_npy = read_whole_file(file), new_json = read_whole_file(npy_sidecar_name(file));
  // The sidecar as it is between the two renames: of the new array, with that of the old one inside.
  std::string both = new_json;
  both.insert(both.rfind('}'), ", \"previous\": " + old_json);
  write_whole_file(npy_sidecar_name(file), both);
  test::expect_same_map(read_map(file), after);
  write_whole_file(file, old_npy);
  test::expect_same_map(read_map(file), before);
  // Writing again from there keeps what was known of the old array until the new one is in place.
  write_map(file, after);
  EXPECT_EQ(read_whole_file(file), new_npy);
  EXPECT_EQ(read_whole_file(npy_sidecar_name(file)), new_json);
}

TEST(NpySidecar, IsNotWrittenBesideWhatCannotBeReplaced) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "a.npy");
  test::expect_input_error([&] { write_map(folder.path() / "a.npy", asymmetric(2)); }, {"a.npy", "directory"});
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(NpySidecar, KnowsNothingOfAnArrayWithoutASidecarBefore) {
  const std::string sha(64, 'a'), other(64, 'b');
  const std::string text =
      R"({"pitch_mm": [1, 2], "sha256": ")" + sha + R"(", "previous": {"sha256": ")" + other + R"("}})";
  EXPECT_EQ(parse_npy_sidecar(text, sha, "a.json").header.pitch, (Point{1, 2}));
  EXPECT_FALSE(parse_npy_sidecar(text, other, "a.json").header.pitch.has_value());
}

// u_side.npy.json: a key `units` was skipped, and heights were a thousand times too small.
TEST(NpySidecar, ReadsTheKeysOfOtherPrograms) {
  const std::string sha(64, 'a');
  const auto said = [&](const std::string& fields) {
    return parse_npy_sidecar("{\"sha256\": \"" + sha + "\", " + fields + "}", sha, "a.json");
  };
  EXPECT_EQ(said(R"("units": "um")").header.unit, "um");
  EXPECT_EQ(said(R"("grid": {"pixel_size_um": 500}, "Height unit": "nm")").header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(said(R"("pitch": 0.5, "pitch_unit": "mm")").header.pitch, (Point{0.5, 0.5}));
  EXPECT_EQ(said(R"("pixel_size": 0.5)").unclear_pitch, "pixel_size = 0.5");
  EXPECT_EQ(said(R"("offset_x_mm": 3)").unclear_origin, "offset_x_mm = 3");
  EXPECT_EQ(said(R"("no_data": -9999)").header.no_data, (std::vector<double>{-9999}));
  EXPECT_FALSE(said(R"("operator": "nobody", "shape": [2, 3], "temperature_unit": "K")").header.unit);
  test::expect_input_error([&] { said(R"("unit": "um", "units": "nm")"); }, {"a.json", "unit = 'um'", "units = 'nm'"});
  test::expect_input_error([&] { said(R"("z_scale": 0.001)"); }, {"a.json", "z_scale = 0.001"});
}

TEST(NpySidecar, ItsMarkersOfNoDataAndItsUnitHoldForTheArray) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.npy";
  const HeightMap map(Grid{1, 3, 1.0, 1.0, {}}, {1.0, -9999.0, 3.0});
  write_whole_file(file, npy_bytes(map));
  write_whole_file(npy_sidecar_name(file),
                   R"({"pitch_mm": [1, 2], "units": "um", "no_data": -9999, "x_offset": 3, "sha256": ")" +
                       sha256_of_file(file) + "\"}");
  MapReadOptions options;
  options.scale = 1.0;
  test::expect_input_error([&] { read_map(file, options); }, {"a.npy", "unit um", "`map unit` um"});
  options.scale.reset();  // what the sidecar says holds
  test::expect_input_error([&] { read_map(file, options); }, {"a.npy", "x_offset = 3", "`map origin`"});
  options.origin = Point{3.0, 0.0};
  const HeightMap read = read_map(file, options);
  EXPECT_EQ(read.at(0, 2), 3000.0);
  EXPECT_TRUE(std::isnan(read.at(0, 1)));
  EXPECT_EQ(read.history, (std::vector<std::string>{"no data: 1 pixel of -9999, as the file says"}));
}

TEST(NpySidecar, TakesOneNumberForBothPitchesAndNullForNothing) {
  const std::string sha(64, 'a');
  const auto header = [&](const std::string& fields) {
    return parse_npy_sidecar("{\"sha256\": \"" + sha + "\", " + fields + "}", sha, "a.json").header;
  };
  EXPECT_EQ(header(R"("pitch_mm": 0.5)").pitch, (Point{0.5, 0.5}));
  const MapHeader none = header(R"("unit": null, "origin_mm": null, "pitch_mm": null, "no_data": null)");
  EXPECT_FALSE(none.unit || none.pitch || none.origin || !none.no_data.empty() || !none.unclear.empty());
  EXPECT_EQ(header(R"("flipped": true)").unclear.size(), 1u);
}

TEST(NpySidecar, NamesWhatItRefuses) {
  const std::string sha(64, 'a');
  const auto refused = [&](const std::string& text, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_npy_sidecar(text, sha, "a.json"); }, words);
  };
  const auto entry = [&](const std::string& field) { return "{\"sha256\": \"" + sha + "\", " + field + "}"; };
  refused("", {"a.json", "no sidecar"});
  refused("{\"sha256\": \"", {"no sidecar"});
  refused("[1, 2]", {"JSON object"});
  refused("{}", {"sha256 = missing"});
  refused("{\"sha256\": 1}", {"sha256 = 1"});
  refused("{\"sha256\": \"abc\"}", {"stale", "'abc'", sha});
  refused("{\"sha256\": \"abc\", \"previous\": 1}", {"previous", "JSON object"});
  refused(entry("\"pitch_mm\": -0.1"), {"pitch_mm = -0.1", "one number > 0, or two [x, y]"});
  refused(entry("\"pitch_mm\": [0.1, 0]"), {"pitch_mm = [0.1,0]", "> 0"});
  refused(entry("\"pitch_mm\": [0.1, 1e999]"), {"no sidecar"});
  refused(entry("\"pitch_mm\": [0.1, null]"), {"pitch_mm"});
  refused(entry("\"origin_mm\": [1]"), {"origin_mm = [1]"});
  refused(entry("\"unit\": 1"), {"unit = 1"});
  refused(entry("\"history\": \"x\""), {"history", "array of strings"});
  refused(entry("\"history\": [1]"), {"history", "array of strings"});
  refused(entry("\"history\": [\"a\\nb\"]"), {"history", "a line each"});
}

}  // namespace
}  // namespace dwell

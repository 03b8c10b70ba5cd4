#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

/// Refused with all parts in the message, nothing printed, no file made and none of the inputs touched.
void expect_refused(const SmallInputs& inputs, const Words& arguments, const Words& parts) {
  const std::size_t before = inputs.folder.entries();
  const std::string map = read_whole_file(inputs / "map.csv"), tif = read_whole_file(inputs / "tif.csv");
  const ProgramResult result = inputs.run(arguments);
  EXPECT_EQ(result.exit_code, 2) << arguments.back() << result.err;
  for (const std::string& part : parts) expect_has(result.err, part);
  EXPECT_EQ(result.out, "") << arguments.back();
  EXPECT_EQ(inputs.folder.entries(), before) << arguments.back();
  EXPECT_EQ(read_whole_file(inputs / "map.csv"), map) << arguments.back();
  EXPECT_EQ(read_whole_file(inputs / "tif.csv"), tif) << arguments.back();
}

/// A user who has named files so that a picture, a text and a map could all be mistaken for an input.
struct NamedInputs : SmallInputs {
  Words map{"map", "map.csv", "--map-pixel", "0.5"};

  NamedInputs() {
    std::filesystem::copy_file(*this / "map.csv", *this / "part.png");
    std::filesystem::create_symlink("part.png", *this / "link.png");
    std::filesystem::create_directory(*this / "folder.png");
  }
};

TEST(OutputFiles, NeverReplaceAnInput) {
  const NamedInputs inputs;
  const Words png{"map", "part.png", "--map-pixel", "0.5"};
  expect_refused(inputs, with(png, {"--png", "part.png"}), {"--png 'part.png'", "same file as the map, which is read"});
  expect_refused(inputs, with(png, {"--psd-png", "./folder.png/../part.png"}), {"--psd-png", "same file as the map"});
  expect_refused(inputs, with(png, {"--profile", "y=1", "--profile-png", "link.png"}), {"--profile-png 'link.png'"});
  expect_refused(inputs, with(inputs.map, {"--step", "subtract:part.png", "--write-image", "part.png"}),
                 {"--write-image 'part.png'", "a map of a step"});
  expect_refused(inputs, with(inputs.map, {"--write", "map.csv"}), {"--write 'map.csv'", "same file as the map"});
  expect_refused(inputs,
                 {"tif", "--spot", "part.png", "--before", "map.csv", "--map-pixel", "0.5", "--dwell-time", "4",
                  "--write", "map.csv"},
                 {"--write 'map.csv'", "--before"});
  expect_refused(inputs, {"tif", "tif.csv", "--tif-pixel", "0.5", "--write", "tif.csv"}, {"the removal function"});
  EXPECT_EQ(read_whole_file(inputs / "part.png"), read_whole_file(inputs / "map.csv"));
}

TEST(OutputFiles, KeepAnEarlierResultReplaceable) {
  const NamedInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const Words words{"holds an earlier plan, which could then no longer be replaced", "give another folder"};
  expect_refused(inputs, with(inputs.map, {"--write", "plan/x.csv"}), with({"--write 'plan/x.csv'"}, words));
  const Words part{"is a file of the earlier plan in 'plan'", "another name and folder"};
  for (const char* name : {"plan/dwell.npy", "plan/residual.npy"})
    expect_refused(inputs, with(inputs.map, {"--write", name}), part);
  expect_refused(inputs, with(inputs.map, {"--png", "plan/before.png"}), part);
  expect_refused(inputs, {"simulate", "plan", "--residual", "plan/residual.npy"}, part);
  expect_refused(inputs, {"simulate", "plan", "--png", "plan/after.png"}, part);
  expect_refused(inputs, {"simulate", "plan", "--json=plan/summary.json"}, {"summary"});
  expect_refused(inputs, with(inputs.map, {"--png", "./plan/x.png"}), words);
  expect_refused(inputs, with(inputs.map, {"--json=plan/x.json"}), words);
  EXPECT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
}

TEST(OutputFiles, NeverReplaceAFolderThatHoldsAnInput) {
  const NamedInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const std::string summary = read_whole_file(inputs / "plan/summary.json");
  const Words tif{"--tif", "tif.csv", "--tif-pixel", "0.5"}, path{"--path", "raster:pitch=1"};
  expect_refused(inputs, with(with({"plan", "--map", "plan/residual.npy", "--out", "plan"}, tif), path),
                 {"--out: 'plan' holds the map 'plan/residual.npy', and is replaced whole; give another folder"});
  expect_refused(inputs, SmallInputs::plan({"--path", "file:plan/feed.csv", "--out", "./plan/"}),
                 {"--out: './plan/' holds the path 'plan/feed.csv'"});
  expect_refused(inputs, SmallInputs::plan({"--map-steps", "subtract:plan/residual.npy"}),
                 {"--out: 'plan' holds a map of a step 'plan/residual.npy'"});
  expect_refused(inputs, SmallInputs::plan({"--tif", "plan/residual.npy"}), {"holds the removal function"});
  const Words comparison = with({"paths", "--map", "map.csv", "--map-pixel", "0.5", "--out", "paths"}, tif);
  ASSERT_EQ(inputs.run(with(comparison, {"--paths", "raster:pitch=1"})).exit_code, 0);
  expect_refused(inputs, with(comparison, {"--paths", "spiral:pitch=1;file:paths/raster/feed.csv"}),
                 {"--out: 'paths' holds the path 'paths/raster/feed.csv'"});
  EXPECT_EQ(read_whole_file(inputs / "plan/summary.json"), summary);
}

TEST(OutputFiles, AreMadeInAtMostOneFolderThatIsMissingUnlessAsked) {
  const NamedInputs inputs;
  expect_refused(inputs, SmallInputs::plan({"--out", "a/b/plan"}), {"--out: neither '", "/a/b' is there", "--parents"});
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--out", "a/plan"})).exit_code, 0);
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--out", "b/c/plan", "--parents"})).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(inputs / "b/c/plan/summary.json"));
}

TEST(OutputFiles, NeverReplaceTheSidecarOrContainerOfAnInput) {
  const NamedInputs inputs;
  ASSERT_EQ(inputs.run(with(inputs.map, {"--write", "a.npy"})).exit_code, 0);
  ASSERT_EQ(inputs.run(with(inputs.map, {"--write", "b.h5"})).exit_code, 0);
  expect_refused(inputs, {"map", "a.npy", "--json=a.npy.json"}, {"--json", "the sidecar of the map"});
  expect_refused(inputs, with(inputs.map, {"--write", "c.npy", "--json=c.npy.json"}), {"the sidecar of --write"});
  expect_refused(inputs, {"map", "b.h5:/anything", "--write", "b.h5"}, {"--write 'b.h5'", "same file as the map"});
}

TEST(OutputFiles, FiguresTakeTheFormatThatTheirNameSays) {
  const NamedInputs inputs;
  ASSERT_EQ(inputs.run(with(inputs.map, {"--png", "a.svg", "--psd-png", "b.PDF"})).exit_code, 0);
  EXPECT_EQ(read_whole_file(inputs / "a.svg").substr(0, 5), "<?xml");
  EXPECT_EQ(read_whole_file(inputs / "b.PDF").substr(0, 5), "%PDF-");
  expect_refused(inputs, with(inputs.map, {"--write-image", "a.svg"}), {"--write-image 'a.svg'", "accepted: .png"});
}

TEST(OutputFiles, AreCheckedBeforeAnyWork) {
  const NamedInputs inputs;
  const Words good = with(inputs.map, {"--json=good.json", "--write", "good.csv"});
  expect_refused(inputs, with(good, {"--png", "a.png", "--psd-png", "./a.png"}),
                 {"--psd-png './a.png'", "same file as --png"});
  expect_refused(inputs, with(good, {"--png", "a.jpg"}), {"--png 'a.jpg'", "'.jpg'", "accepted: .png"});
  expect_refused(inputs, with(good, {"--png", "no/such/a.png"}), {"--png 'no/such/a.png'", "no folder 'no/such'"});
  expect_refused(inputs, with(good, {"--png", "folder.png"}), {"--png 'folder.png'", "is a folder"});
  expect_refused(inputs, with(inputs.map, {"--json=a.txt"}), {"--json 'a.txt'", "accepted: .json"});
  expect_refused(inputs, with(inputs.map, {"--json=a.json", "--write", "a.tif"}),
                 {"--write 'a.tif'", "accepted: .csv", ".npy"});
  expect_refused(inputs, with(good, {"--profile", "y=99"}), {"does not lie on the map"});
  expect_refused(inputs, {"tif", "tif.csv", "--tif-pixel", "0.5", "--json=t.json", "--mtf-png", "t.bmp"},
                 {"--mtf-png 't.bmp'", "accepted: .png"});
  // The program is missing: the name of the output is found wrong before that.
  expect_refused(inputs,
                 {"simulate", "--program", "none.nc", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv",
                  "--tif-pixel", "0.5", "--residual", "map.csv"},
                 {"--residual 'map.csv'", "same file as the map"});
}

TEST(OutputFiles, MayReplaceAnEarlierOutput) {
  const NamedInputs inputs;
  for (int round = 0; round < 2; ++round) {
    const ProgramResult result = inputs.run(with(inputs.map, {"--png", "a.PNG", "--write", "a.npy"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_whole_file(inputs / "a.PNG").substr(1, 3), "PNG");
  }
}

TEST(Inputs, ThatArePipesAreRefusedAtOnce) {
  const SmallInputs inputs;
  ASSERT_EQ(::mkfifo((inputs / "pipe").c_str(), 0600), 0);
  for (const char* file : {"pipe", "/dev/zero"}) {
    const ProgramResult result = inputs.run({"map", file, "--map-pixel", "0.5"});
    EXPECT_EQ(result.exit_code, 2);
    expect_has(result.err, "'" + std::string(file) + "' is a ");
    expect_has(result.err, "a regular file is required");
  }
}

}  // namespace
}  // namespace dwell

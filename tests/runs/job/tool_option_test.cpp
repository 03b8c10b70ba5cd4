#include "runs/job/tool_option.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runs/job/job_file.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::expect_input_error;

constexpr const char* kTwo =
    "large;tif=gaussian:peak=20,fwhm=8,radius=12;path=raster:pitch=2\n"
    "small ; tif = spot.csv ; tif-pixel = 0.1 ; path=file:way.csv; price=2.5;change-over=1.5min;max-feed=600";

TEST(ToolOption, IsANameAndWhatIsItsOwn) {
  const std::vector<ToolSpec> tools = parse_tool_specs(kTwo);
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].name, "large");
  EXPECT_EQ(tools[0].price, 1.0);
  EXPECT_EQ(tools[0].change_over_s, 0.0);
  EXPECT_EQ(tools[1].name, "small");
  EXPECT_EQ(tools[1].price, 2.5);
  EXPECT_EQ(tools[1].change_over_s, 90.0);
  JobOptions common;
  common.tif = "other.csv";
  common.max_feed_mm_per_min = 1000.0;
  common.tools = kTwo;
  const JobOptions large = options_of_tool(common, tools[0]), small = options_of_tool(common, tools[1]);
  EXPECT_EQ(large.tif, "gaussian:peak=20,fwhm=8,radius=12");
  EXPECT_EQ(large.max_feed_mm_per_min, 1000.0);
  EXPECT_TRUE(large.tools.empty());
  EXPECT_EQ(small.tif, "spot.csv");
  EXPECT_EQ(small.max_feed_mm_per_min, 600.0);
  EXPECT_EQ(small.tif_pixel_mm->x, 0.1);
}

TEST(ToolOption, TellsATimeByItsUnit) {
  const auto seconds = [](const std::string& text) {
    return parse_tool_specs("a;change-over=" + text + "\nb")[0].change_over_s;
  };
  EXPECT_EQ(seconds("90s"), 90.0);
  EXPECT_EQ(seconds("10min"), 600.0);
  EXPECT_EQ(seconds("0.5 h"), 1800.0);
  for (const char* wrong : {"10", "10m", "10ms", "-1s", "nan s", "s", "1e9h", "inf min"})
    expect_input_error([&] { seconds(wrong); }, {"tool 'a'", "change-over", wrong, "90s, 10min or 0.5h"});
}

TEST(ToolOption, RefusesWhatItCannotBe) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    expect_input_error([&] { parse_tool_specs(text); }, words);
  };
  refused("a;tif=x", {"1 given", "2 to 6"});
  refused("a\nb\nc\nd\ne\nf\ng", {"7 given"});
  refused("a\na", {"'a' is given twice"});
  refused("\na", {"begins with its name"});
  refused("tif=x;path=y\nb", {"'tif=x'", "begins with its name"});
  refused("a/b\nc", {"'a/b'"});
  refused("..\nc", {"'..'"});
  refused("a;tif=x;tif=y\nb", {"'a'", "tif is given twice"});
  refused("a;tif=\nb", {"'a'", "tif: empty"});
  refused("a;tif\nb", {"'a'", "tif: empty"});
  refused("a;price=0\nb", {"'a'", "price", "'0'", "0.001"});
  refused("a;price=nan\nb", {"'a'", "price", "'nan'"});
}

TEST(ToolOption, IsOneThatAToolCanHave) {
  const auto refused = [](const std::string& part, std::initializer_list<std::string> words) {
    expect_input_error([&] { options_of_tool({}, parse_tool_specs("a;" + part + "\nb")[0]); }, words);
  };
  refused("map=x", {"'a'", "map: not a tool's own", "tif-pixel", "change-over"});
  refused("tif-steps=x", {"'a'", "tif-steps: not a tool's own"});
  refused("max-feed=0", {"'a'", "max-feed", "'0'"});
}

TEST(ToolOption, HasFilesThatAreNamedFromTheJobsFolder) {
  const auto& table = job_option_table();
  const auto record = std::find_if(table.begin(), table.end(), [](const auto& row) { return row.key == "tool"; });
  const std::string renamed = rebased_option(*record, kTwo, "/job", "tool");
  const std::vector<ToolSpec> tools = parse_tool_specs(renamed);
  EXPECT_EQ(options_of_tool({}, tools[0]).tif, "gaussian:peak=20,fwhm=8,radius=12");
  EXPECT_EQ(options_of_tool({}, tools[1]).tif, "/job/spot.csv");
  EXPECT_EQ(to_string(options_of_tool({}, tools[1]).path), "file:/job/way.csv");
  EXPECT_EQ(tools[1].change_over_s, 90.0);
  EXPECT_EQ(tools[1].price, 2.5);
}

JobOptions read_job(const test::TemporaryFolder& folder, const std::string& text) {
  JobOptions options;
  read_job_file(folder.file("job.toml", text), options);
  return options;
}

TEST(ToolOption, StandsInAJobFileAsATable) {
  const test::TemporaryFolder folder;
  const JobOptions options =
      read_job(folder,
               "schema = 2\nmax_feed_mm_per_min = 900\n"
               "[[tool]]\nname = \"large\"\ntif = \"gaussian:peak=20,fwhm=8,radius=12\"\n"
               "path = \"raster:pitch=2\"\n"
               "[[tool]]\nname = \"small\"\ntif = \"spot.csv\"\ntif_pixel_mm = 0.1\nprice = 2.5\n"
               "change_over = \"90s\"\nmax_feed_mm_per_min = 600\n"
               "machine = { path_acceleration_mm_per_s2 = 500 }\n");
  const std::vector<ToolSpec> tools = parse_tool_specs(options.tools);
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].name, "large");
  const JobOptions small = options_of_tool(options, tools[1]);
  EXPECT_EQ(small.tif, (folder.path() / "spot.csv").string());
  EXPECT_EQ(small.max_feed_mm_per_min, 600.0);
  EXPECT_NE(small.machine.find("500"), std::string::npos);
  EXPECT_EQ(tools[1].price, 2.5);
  EXPECT_EQ(read_job(folder, job_file_text(options)).tools, options.tools);
  const JobOptions listed = read_job(folder, "tool = [\"a;tif=x.csv\", \"b;price=2\"]\n");
  EXPECT_EQ(parse_tool_specs(listed.tools)[1].price, 2.0);
}

TEST(ToolOption, InAJobFileIsRefusedByNameAndField) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& text, std::initializer_list<std::string> words) {
    expect_input_error([&] { read_job(folder, text); }, words);
  };
  refused("[[tool]]\ntif = \"x\"\n[[tool]]\nname = \"b\"\n", {"job.toml", "tool", "without a name", "name = "});
  refused("[[tool]]\nname = \"a\"\nspeed = 3\n[[tool]]\nname = \"b\"\n",
          {"job.toml: tool", "'a'", "speed", "not a tool's own"});
  refused("[[tool]]\nname = \"a\"\ntif = \"x;path=y\"\n[[tool]]\nname = \"b\"\n", {"job.toml: tool", "semicolons"});
  refused("[[tool]]\nname = \"a\"\ntif = true\n[[tool]]\nname = \"b\"\n",
          {"job.toml: tool", "'a'", "tif is empty or of type boolean"});
  refused("tool = 3\n", {"job.toml: tool", "tables [[tool]], or a list of strings"});
  refused("tool = []\n", {"job.toml: tool"});
  refused("[tool]\nname = \"a\"\n", {"job.toml: tool", "[[tool]]"});
}

}  // namespace
}  // namespace dwell

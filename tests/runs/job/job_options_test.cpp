#include "runs/job/job_options.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

const JobOptionRecord& record_of(const std::string& flag) {
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.flag == flag) return record;
  }
  throw std::logic_error("no option " + flag);
}

void set(JobOptions& options, const std::string& flag, const std::string& text) {
  set_job_option(options, record_of(flag), text, "--" + flag);
}

TEST(JobOptionTable, KnowsEveryOptionOnceByFlagAndByKey) {
  std::set<std::string> flags, keys;
  for (const JobOptionRecord& record : job_option_table()) {
    EXPECT_TRUE(flags.insert(record.flag).second) << record.flag;
    EXPECT_TRUE(keys.insert(record.key).second) << record.key;
    EXPECT_FALSE(record.help.empty()) << record.flag;
    EXPECT_FALSE(record.value.empty()) << record.flag;
  }
  for (const char* flag :
       {"map", "map-pixel", "map-unit", "map-origin", "tif", "tif-unit", "tif-pixel", "path", "motion", "remove",
        "aperture", "min-dwell", "max-feed", "smoothness", "time-price", "solver", "threads", "gcode", "out"}) {
    EXPECT_TRUE(flags.contains(flag)) << flag;
  }
}

TEST(JobOptionTable, AcceptsItsOwnDefaults) {
  const JobOptions defaults;
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string text = record.get(defaults);
    if (text.empty()) continue;
    JobOptions options;
    set(options, record.flag, text);
    EXPECT_EQ(record.get(options), text) << record.flag;
  }
}

TEST(JobOptionTable, GivesBackWhatItIsGiven) {
  for (const auto& [flag, text] :
       std::initializer_list<std::pair<const char*, const char*>>{{"map-pixel", "0.0938"},
                                                                  {"map-pixel", "0.5,0.25"},
                                                                  {"tif-pixel", "0.2,0.125"},
                                                                  {"fraction", "0.8"},
                                                                  {"map-unit", "waves"},
                                                                  {"wavelength", "632.8"},
                                                                  {"wave-scale", "0.5"},
                                                                  {"fraction", "1"},
                                                                  {"map-unit", "um"},
                                                                  {"map-origin", "-12.5,3"},
                                                                  {"map-no-data", "-9999,32767"},
                                                                  {"map-no-data", "none"},
                                                                  {"map-max-pv", "12.5"},
                                                                  {"map-table", "index"},
                                                                  {"map-rows", "top"},
                                                                  {"map-grid", "pitch=0.5,reach=2"},
                                                                  {"map-steps", "crop:data;fill:harmonic"},
                                                                  {"max-pixels", "1000000000"},
                                                                  {"tif-unit", "um/min"},
                                                                  {"tif-centre", "0.25,-1"},
                                                                  {"path", "nearest:cell=2"},
                                                                  {"motion", "stop"},
                                                                  {"remove", "none"},
                                                                  {"aperture", "polygon:0,0,4,0,2,3"},
                                                                  {"min-dwell", "0.1"},
                                                                  {"max-feed", "1234.5"},
                                                                  {"smoothness", "step<=0.004"},
                                                                  {"time-price", "1e-07"},
                                                                  {"solver", "dense-nnls"},
                                                                  {"threads", "2"},
                                                                  {"gcode", "g93-seconds"}}) {
    JobOptions options;
    set(options, flag, text);
    EXPECT_EQ(record_of(flag).get(options), text) << flag;
  }
}

TEST(JobOptionTable, RefusesWhatIsOutOfRangeNamingOptionValueAndRange) {
  JobOptions options;
  for (const char* flag : {"map-pixel", "tif-pixel", "max-feed", "max-solve", "lift-height"}) {
    for (const char* text : {"0", "-1", "nan", "inf", "1e999", "1 mm", "abc"}) {
      expect_input_error([&] { set(options, flag, text); }, {std::string("--") + flag, text, "required a number from"});
    }
  }
  for (const char* flag : {"min-dwell", "smoothness", "time-price"}) {
    for (const char* text : {"-1e-9", "nan", "inf", "x"}) {
      expect_input_error([&] { set(options, flag, text); },
                         {std::string("--") + flag, text, "required a number from 0 to"});
    }
  }
  const auto beyond = [&](const char* flag, const char* text, const std::string& range) {
    expect_input_error([&] { set(options, flag, text); }, {std::string("--") + flag, text, range});
  };
  beyond("map-pixel", "1e-7", "a number from 1e-06 to 10000 (mm)");
  beyond("tif-pixel", "1e300", "a number from 1e-06 to 10000 (mm)");
  beyond("tif-dwell-time", "1e300", "a number from 1e-09 to 1e+08 (s)");
  beyond("min-dwell", "1e300", "a number from 0 to 1e+07 (s)");
  beyond("max-feed", "1e-9", "a number from 0.01 to 1e+07 (mm/min)");
  beyond("max-feed", "1e300", "a number from 0.01 to 1e+07 (mm/min)");
  beyond("smoothness", "1e300", "a number from 0 to 1e+09");
  beyond("smoothness", "step<=1e300", "'step<=S'");
  beyond("time-price", "1e300", "a number from 0 to 1e+15 (nm^2/s)");
  beyond("max-solve", "1e300", "a number from 1e-09 to 1e+08 (s)");
  beyond("lift-height", "1e300", "a number from 1e-06 to 1e+06 (mm)");
  beyond("map-origin", "1e300,0", "each a number from -1e+06 to 1e+06 (mm)");
  beyond("tif-centre", "0,1e300", "X,Y in mm");
  beyond("aperture", "circle:0,0,1e300", "a number from -1e+06 to 1e+06 (mm)");
  beyond("path", "spiral:pitch=1,centre=1e300/0", "a number from -1e+06 to 1e+06 (mm)");
  beyond("path", "raster:pitch=1e300", "a number from");
  for (const char* text : {"-1", "1.5", "nan", "1025", "two"}) {
    expect_input_error([&] { set(options, "threads", text); }, {"--threads", text, "whole number"});
  }
  for (const char* text : {"0", "1.5", "nan", "2147483649", "many"}) {
    expect_input_error([&] { set(options, "max-pixels", text); }, {"--max-pixels", text, "from 1 to 2147483648"});
  }
}

TEST(JobOptionTable, RefusesUnknownWordsNamingTheAcceptedOnes) {
  JobOptions options;
  const auto refused = [&options](const char* flag, const char* text, std::initializer_list<std::string> words) {
    expect_input_error([&] { set(options, flag, text); }, {std::string("--") + flag, text});
    expect_input_error([&] { set(options, flag, text); }, words);
  };
  refused("map-unit", "furlong", {"nm", "um", "mm"});
  refused("tif-unit", "furlong/s", {"nm/s", "um/min", "m/s"});
  refused("tif-unit", "furlong", {"nm", "um", "mm"});
  refused("map-origin", "1", {"X,Y"});
  refused("map-origin", "1,nan", {"X,Y"});
  refused("map-no-data", "nan", {"finite number", "none"});
  refused("map-table", "rows", {"heights", "index", "mm"});
  refused("map-grid", "0.5", {"pitch=MM[,reach=MM]"});
  refused("map-grid", "reach=1", {"pitch=MM[,reach=MM]"});
  refused("tif-grid", "pitch=-1", {"both > 0"});
  refused("tif-centre", "left", {"middle", "centroid", "X,Y"});
  refused("path", "zigzag:pitch=1", {"raster", "nearest", "file"});
  refused("motion", "go", {"moving", "stop"});
  refused("remove", "piston,coma", {"piston", "tilt", "power"});
  refused("aperture", "square:1", {"map", "rect", "circle", "ellipse", "annulus", "polygon"});
  refused("map-steps", "polish:1", {"unknown step 'polish'", "resample"});
  refused("solver", "magic", {"projected-cg", "dense-nnls"});
  refused("gcode", "g95", {"g94", "g93-per-minute", "g93-seconds"});
}

TEST(JobOptionTable, RefusesEmptyText) {
  JobOptions options;
  for (const JobOptionRecord& record : job_option_table()) {
    expect_input_error([&] { set(options, record.flag, ""); }, {"--" + record.flag, "empty"});
  }
}

}  // namespace
}  // namespace dwell

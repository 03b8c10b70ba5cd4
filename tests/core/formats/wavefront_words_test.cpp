#include "core/formats/wavefront_words.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(WavefrontWords, CallDataAPathDifference) {
  for (const char* text : {"OPD",
                           "opd",
                           "OPD_map",
                           "m1_opd_2",
                           "opdMap",
                           "OPDMap",
                           "/run/opd1",
                           "WFR",
                           "rms-wfe",
                           "WFE_RMS",
                           "wavefront",
                           "Wavefront error",
                           "transmittedWavefront",
                           "wave front",
                           "optical path difference",
                           "Wellenfront",
                           "front d'onde",
                           "(OPD)",
                           "double pass",
                           "measured in double-pass"}) {
    EXPECT_TRUE(names_wavefront(text)) << text;
  }
  for (const char* text : {"", "surface", "opdrachtgever", "wave", "dropdown", "path", "front", "heights in waves",
                           "topdown", "UPDATE", "copd", "two passes of polishing"}) {
    EXPECT_FALSE(names_wavefront(text)) << text;
  }
}

TEST(WavefrontWords, SayWhereTheyStand) {
  MapHeader header;
  note_wavefront("height [nm]", "map a.csv", "it", header);
  EXPECT_TRUE(header.unclear.empty());
  note_wavefront("OPD [nm]", "map a.csv, line 3", "'OPD [nm]'", header);
  ASSERT_EQ(header.unclear.size(), 1u);
  EXPECT_EQ(header.unclear[0].about, UnclearStatement::About::Wavefront);
  EXPECT_EQ(header.unclear[0].message.find("map a.csv, line 3: 'OPD [nm]'"), 0u);
}

}  // namespace
}  // namespace dwell

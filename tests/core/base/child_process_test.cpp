#include "core/base/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <new>

#include "core/formats/isolated_reader.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

constexpr ChildLimits kLimits{2.0, std::size_t{1} << 30};

TEST(ChildProcess, HandsBackTheAnswerAndNothingElse) {
  const std::string bytes = std::string("a\0b", 3) + std::string(3 << 20, 'x');
  int changed = 0;
  const auto answer = output_of_child(
      [&](const AnswerSink& sink) {
        changed = 1;
        sink(bytes);
        sink("end");
      },
      kLimits);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->bytes(), bytes + "end");
  EXPECT_EQ(changed, 0);
  const auto nothing = output_of_child([](const AnswerSink&) {}, kLimits);
  ASSERT_TRUE(nothing.has_value());
  EXPECT_EQ(nothing->bytes(), "");
}

TEST(ChildProcess, OutlivesACrashAndAnEndlessLoop) {
  EXPECT_FALSE(output_of_child([](const AnswerSink&) { std::abort(); }, kLimits));
  EXPECT_FALSE(output_of_child([](const AnswerSink&) { std::raise(SIGSEGV); }, kLimits));
  EXPECT_FALSE(output_of_child(
      [](const AnswerSink& sink) {
        sink("half");
        std::_Exit(0);
      },
      kLimits))
      << "an end in the middle of an answer";
  volatile bool on = true;
  EXPECT_FALSE(output_of_child(
      [&](const AnswerSink&) {
        while (on) {
        }
      },
      {1.0, std::size_t{1} << 30}));
}

TEST(IsolatedReader, PassesOnMapsAndMessages) {
  MapSource source;
  source.rows = 1;
  source.cols = 2;
  source.values = {1.5, -2.5};
  source.header.pitch = Point{0.25, 0.5};
  source.header.unit = "nm";
  source.header.history = {"a", ""};
  source.pitch_hint = "hint";
  source.camera_pixel = {3.0, -4.0};
  const MapSource read = read_isolated([&] { return source; }, 10, "the file", "map a");
  EXPECT_EQ(read.rows, 1);
  EXPECT_EQ(read.cols, 2);
  EXPECT_EQ(read.values, source.values);
  EXPECT_EQ(read.header.pitch, source.header.pitch);
  EXPECT_EQ(read.header.origin, source.header.origin);
  EXPECT_EQ(read.header.unit, source.header.unit);
  EXPECT_EQ(read.header.history, source.header.history);
  EXPECT_EQ(read.pitch_hint, "hint");
  EXPECT_EQ(read.camera_pixel, source.camera_pixel);
  const auto fails_with = [](const std::function<MapSource()>& fail, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { read_isolated(fail, 10, "the X file", "map a"); }, words);
  };
  fails_with([]() -> MapSource { throw InputError("map a: byte 3"); }, {"map a: byte 3"});
  fails_with([]() -> MapSource { std::abort(); }, {"map a", "the X file of 10 bytes is corrupt"});
  fails_with([]() -> MapSource { throw std::bad_alloc(); }, {"map a", "corrupt", "GiB"});
  EXPECT_THROW(read_isolated([]() -> MapSource { throw std::logic_error("ours"); }, 10, "", ""), std::runtime_error);
  EXPECT_THROW(read_isolated([] { return MapSource(); }, 10, "", ""), std::runtime_error);
}

}  // namespace
}  // namespace dwell

#include "bench/measurements.h"

#include <gmock/gmock.h>

#include <limits>

#include "bench/scratch_folder.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Json kHere{{"commit", "abc"}, {"cores", 2}};

class MeasurementsTest : public testing::Test {
 protected:
  /// What the file is refused for; empty if it is not.
  std::string refusal(const Json& circumstances) const {
    try {
      const Measurements again(file_, circumstances);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "results.json";
};

TEST_F(MeasurementsTest, AreWrittenOneByOneAndTakenOver) {
  {
    Measurements first(file_, kHere);
    EXPECT_EQ(first.taken_over(), 0U);
    EXPECT_EQ(first.take("plans/a", [] { return Json{{"seconds", 3.5}}; }), (Json{{"seconds", 3.5}}));
    // At once, not at the end: this is what an interrupt leaves.
    EXPECT_EQ(Measurements(file_, kHere).taken_over(), 1U);
    first.take("plans/b", [] { return Json(7); });
  }
  Measurements again(file_, kHere);
  EXPECT_EQ(again.taken_over(), 2U);
  bool measured = false;
  EXPECT_EQ(again.take("plans/a", [&] { return measured = true, Json(); }), (Json{{"seconds", 3.5}}));
  EXPECT_FALSE(measured);
  again.take("micro", [&] { return measured = true, Json(1); });
  EXPECT_TRUE(measured);
  EXPECT_EQ(Measurements(file_, kHere).taken_over(), 3U);
}

TEST_F(MeasurementsTest, ThatWereBrokenOffLeaveTheFileAsItWas) {
  Measurements first(file_, kHere);
  first.take("a", [] { return Json(1); });
  const std::string before = read_whole_file(file_);
  EXPECT_THROW(first.take("b", []() -> Json { throw std::runtime_error("interrupted"); }), std::runtime_error);
  EXPECT_EQ(read_whole_file(file_), before);
  EXPECT_EQ(first.take("b", [] { return Json(2); }), Json(2));
}

TEST_F(MeasurementsTest, OfAnotherCommitOrMachineAreRefusedWithBothValues) {
  Measurements(file_, kHere).take("a", [] { return Json(1); });
  EXPECT_EQ(refusal(kHere), "");
  EXPECT_THAT(
      refusal({{"commit", "def"}, {"cores", 2}}),
      AllOf(HasSubstr("results.json"), HasSubstr("commit = \"abc\""), HasSubstr("\"def\" now"), HasSubstr("--anew")));
  EXPECT_THAT(refusal({{"commit", "abc"}, {"cores", 4}}), HasSubstr("cores = 2"));
  EXPECT_THAT(refusal({{"commit", "abc"}}), HasSubstr("cores = 2"));
  EXPECT_THAT(refusal({{"commit", "abc"}, {"cores", 2}, {"parts", "all"}}), HasSubstr("parts = null"));
}

TEST_F(MeasurementsTest, InADamagedFileAreRefusedAndNotReplaced) {
  Measurements(file_, kHere).take("a", [] { return Json(1); });
  const std::string whole = read_whole_file(file_);
  for (
      const std::string& bad :
      {whole.substr(0, whole.size() / 2), std::string(), std::string("[]"), std::string("{\"schema\": 1}"),
       std::string(R"({"schema": 2, "circumstances": {}, "measurements": {}})"),
       std::string(R"({"schema": 1, "circumstances": 5, "measurements": {}})"),
       std::string(
           R"({"schema": 1, "circumstances": {"commit": "abc", "cores": 2}, "measurements": {"a": {"result": 1}}})"),
       std::string(
           R"({"schema": 1, "circumstances": {"commit": "abc", "cores": 2}, "measurements": {"a": {"result": 1, "seconds": null}}})")}) {
    write_whole_file(file_, bad);
    EXPECT_THAT(refusal(kHere), HasSubstr("results.json")) << bad;
    EXPECT_EQ(read_whole_file(file_), bad);
  }
}

TEST_F(MeasurementsTest, WithoutAFileAreKeptInMemory) {
  Measurements memory;
  memory.take("plans/a", [] { return Json(1); });
  bool measured = false;
  EXPECT_EQ(memory.take("plans/a", [&] { return measured = true, Json(2); }), Json(1));
  EXPECT_FALSE(measured);
  EXPECT_GE(memory.seconds("plans"), 0.0);
  EXPECT_EQ(memory.seconds("micro"), 0.0);
}

TEST_F(MeasurementsTest, KeepANanAsWhatJsonMakesOfIt) {
  Measurements first(file_, kHere);
  first.take("a", [] { return Json{{"x", std::numeric_limits<double>::quiet_NaN()}}; });
  Measurements again(file_, kHere);
  EXPECT_TRUE(again.take("a", [] { return Json(); }).at("x").is_null());
}

}  // namespace
}  // namespace dwell::bench

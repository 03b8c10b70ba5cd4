#include "core/base/unfinished_output.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>

#include "core/base/whole_file.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// What give_up_outputs() leaves locked is for a process that ends, so every case is a process of its own.
class GiveUpOutputs : public testing::Test {
 protected:
  GiveUpOutputs() { GTEST_FLAG_SET(death_test_style, "fast"); }

  /// Ends this process as a command that is interrupted: 7, or 8 if a result was in place already.
  [[noreturn]] static void give_up() {
    int code = 0;
    std::thread([&] { code = give_up_outputs() ? 7 : 8; }).join();
    _exit(code);
  }

  using Kind = UnfinishedOutput::Kind;

  static std::function<fs::path()> made(const fs::path& folder) {
    return [folder] {
      fs::create_directory(folder);
      return folder;
    };
  }

  TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path() / "a", inner_ = folder_ / "b", result_ = temporary_.path() / "result";
};

TEST_F(GiveUpOutputs, RemovesWhatIsUnfinishedFromAnotherThread) {
  EXPECT_EXIT(
      {
        const UnfinishedOutput parent(Kind::EmptyFolder, made(folder_));
        const UnfinishedOutput output(Kind::Folder, made(inner_));
        write_whole_file(inner_ / "file", "in an unfinished folder, so not a result");
        give_up();
      },
      testing::ExitedWithCode(7), "");
  EXPECT_EQ(temporary_.entries(), 0u);
}

TEST_F(GiveUpOutputs, LeavesAParentThatHoldsSomethingElse) {
  EXPECT_EXIT(
      {
        const UnfinishedOutput parent(Kind::EmptyFolder, made(folder_));
        std::ofstream(folder_ / "of somebody else") << "kept";
        give_up();
      },
      testing::ExitedWithCode(7), "");
  EXPECT_TRUE(fs::exists(folder_ / "of somebody else"));
}

TEST_F(GiveUpOutputs, ComesTooLateForAResult) {
  EXPECT_EXIT(
      {
        write_whole_file(result_, "whole");
        give_up();
      },
      testing::ExitedWithCode(8), "");
  EXPECT_EQ(read_whole_file(result_), "whole");
  EXPECT_EQ(temporary_.entries(), 1u);
}

TEST_F(GiveUpOutputs, LetsNothingBePutInPlaceAfterwards) {
  EXPECT_EXIT(
      {
        std::thread giver([] { EXPECT_TRUE(give_up_outputs()); });
        giver.join();
        std::thread([&] {
          write_whole_file(result_, "too late");
          _exit(1);
        }).detach();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        _exit(7);
      },
      testing::ExitedWithCode(7), "");
  EXPECT_EQ(temporary_.entries(), 0u);
}

TEST_F(GiveUpOutputs, WaitsForAGroup) {
  EXPECT_EXIT(
      {
        std::thread giver;
        {
          const OutputGroup together;
          write_whole_file(result_, "one");
          giver = std::thread([] { _exit(give_up_outputs() ? 7 : 8); });
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          write_whole_file(temporary_.path() / "other", "two");
        }
        giver.join();
      },
      testing::ExitedWithCode(8), "");
  EXPECT_EQ(temporary_.entries(), 2u);
}

TEST(UnfinishedOutput, OfWhichNothingWasMadeIsNotKnown) {
  const TemporaryFolder temporary;
  const fs::path path = temporary.path() / "a";
  const auto fail = []() -> fs::path { throw std::runtime_error("full"); };
  EXPECT_THROW(UnfinishedOutput(UnfinishedOutput::Kind::File, fail), std::runtime_error);
  std::ofstream(path) << "made by another";
  EXPECT_EXIT(
      {
        give_up_outputs();
        _exit(7);
      },
      testing::ExitedWithCode(7), "");
  EXPECT_TRUE(fs::exists(path));
}

TEST(UnfinishedOutput, LeavesAFileOfItsOldNameAloneOnceItIsInPlace) {
  const TemporaryFolder temporary;
  const fs::path path = temporary.path() / "a", target = temporary.path() / "result";
  {
    UnfinishedOutput output(UnfinishedOutput::Kind::File, [&] { return temporary.file("a", "whole"); });
    output.put_in_place(target, [&] { fs::rename(path, target); });
    std::ofstream(path) << "of another process";
  }
  EXPECT_EQ(read_whole_file(path), "of another process");
  EXPECT_EQ(read_whole_file(target), "whole");
}

}  // namespace
}  // namespace dwell

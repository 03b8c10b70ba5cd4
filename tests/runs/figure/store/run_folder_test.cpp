#include "runs/figure/store/run_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "runs/figure/store/run_lock.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

std::string bytes_of_step(int number) {
  return std::string(20000 + static_cast<std::size_t>(number) * 17, static_cast<char>('a' + number % 26));
}

void fill(const OutputFolder& folder, int number) {
  folder.write("map.bin", bytes_of_step(number));
  folder.write("words.txt", "step " + std::to_string(number));
}

RunFolder made_run(const fs::path& folder) {
  return make_run_folder(folder, [](const OutputFolder& f) {
    fill(f, 1);
    return nlohmann::ordered_json{{"target", "rms<=1nm"}};
  });
}

void append(RunFolder& run, const char* kind, int iteration) {
  const int number = static_cast<int>(run.steps().size()) + 1;
  run.append(kind, iteration, [&](const OutputFolder& f) {
    fill(f, number);
    return nlohmann::ordered_json{{"n", number}};
  });
}

std::string refusal_of(const fs::path& folder) {
  try {
    RunFolder run(folder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunFolder, KeepsStepsAsTheyWereWritten) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  {
    RunFolder run = made_run(folder);
    append(run, "plan", 1);
    append(run, "measured", 1);
  }
  const RunFolder run(folder);
  ASSERT_EQ(run.steps().size(), 3U);
  EXPECT_EQ(run.steps()[0].folder, "01-new");
  EXPECT_EQ(run.steps()[2].folder, "03-measured-1");
  EXPECT_EQ(run.steps()[2].kind, "measured");
  EXPECT_EQ(run.steps()[2].iteration, 1);
  EXPECT_EQ(run.steps()[0].content.at("target"), "rms<=1nm");
  EXPECT_EQ(read_whole_file(run.path_of(run.steps()[1]) / "map.bin"), bytes_of_step(2));
  EXPECT_TRUE(run.faults().empty());
}

TEST(RunFolder, SeesWhatIsChanged) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  RunFolder run = made_run(folder);
  append(run, "plan", 1);
  std::ofstream(folder / "02-plan-1/map.bin", std::ios::app) << "x";
  std::ofstream(folder / "02-plan-1/more.txt") << "x";
  fs::remove(folder / "01-new/words.txt");
  const auto faults = RunFolder(folder).faults();
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_NE(faults[0].find("01-new/words.txt: is missing"), std::string::npos) << faults[0];
  EXPECT_NE(faults[1].find("02-plan-1/map.bin: is another than when it was written (20035 of 20034 bytes)"),
            std::string::npos)
      << faults[1];
  EXPECT_NE(faults[2].find("02-plan-1/more.txt: was not there"), std::string::npos) << faults[2];
}

TEST(RunFolder, RefusesAChainThatIsBroken) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  RunFolder run = made_run(folder);
  for (int k = 1; k <= 3; ++k) append(run, "plan", k);
  EXPECT_EQ(refusal_of(folder), "");
  fs::rename(folder / "03-plan-2", folder / "elsewhere");
  EXPECT_NE(refusal_of(folder).find("step 3 is missing"), std::string::npos);
  fs::rename(folder / "elsewhere", folder / "03-plan-2");
  std::string text = read_whole_file(folder / "02-plan-1/step.json");
  text.replace(text.find("\"n\": 2"), 6, "\"n\": 9");
  std::ofstream(folder / "02-plan-1/step.json") << text;
  EXPECT_NE(refusal_of(folder).find("03-plan-2/step.json: the step before it is another"), std::string::npos);
  std::ofstream(folder / "02-plan-1/step.json") << "{}";
  EXPECT_NE(refusal_of(folder).find("no step of a figure run"), std::string::npos);
  EXPECT_NE(refusal_of(temporary.path()).find("no figure run"), std::string::npos);
  EXPECT_THROW(made_run(folder), InputError);  // never replaced
}

TEST(RunFolder, IsAsBeforeWhereAStepFails) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  RunFolder run = made_run(folder);
  const auto fail = [](const OutputFolder& f) -> nlohmann::ordered_json {
    f.write("map.bin", "half");
    throw InputError("no");
  };
  EXPECT_THROW(run.append("plan", 1, fail), InputError);
  EXPECT_EQ(run.steps().size(), 1U);
  EXPECT_EQ(RunFolder(folder).steps().size(), 1U);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 1U);
}

/// Runs an action in a process of its own; returns how that ended (waitpid).
template <class Action>
pid_t in_a_process(const Action& action) {
  const pid_t child = fork();
  if (child != 0) return child;
  int code = 1;
  try {
    code = action();
  } catch (...) {
    code = 2;
  }
  _exit(code);
}

int end_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(RunFolder, IsAsBeforeOnADiskThatTakesNoMore) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  made_run(folder);
  const int status = end_of(in_a_process([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10000, 10000};
    setrlimit(RLIMIT_FSIZE, &limit);
    RunFolder run(folder);
    try {
      append(run, "plan", 1);
    } catch (const InputError&) {
      return 7;
    }
    return 0;
  }));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  const RunFolder run(folder);
  EXPECT_EQ(run.steps().size(), 1U);
  EXPECT_TRUE(run.faults().empty());
}

/// How often a process is killed: 20 times, or what DWELL_KILLS says.
int kills() {
  const char* wanted = std::getenv("DWELL_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 20;
}

TEST(RunFolder, ReopensAtTheLastWholeStepWhereverItIsKilled) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "run";
  made_run(folder);
  std::mt19937 random(17);
  std::size_t before = 1;
  int stale = 0;
  for (int k = 0; k < kills(); ++k) {
    const pid_t child = in_a_process([&] {
      const RunLock lock(folder);
      RunFolder run(folder);
      for (int iteration = 1;; ++iteration) append(run, "plan", iteration);
      return 0;
    });
    std::this_thread::sleep_for(std::chrono::microseconds(std::uniform_int_distribution<int>(500, 200000)(random)));
    kill(child, SIGKILL);
    ASSERT_TRUE(WIFSIGNALED(end_of(child)));
    const RunFolder run(folder);
    EXPECT_GE(run.steps().size(), before);
    EXPECT_TRUE(run.faults().empty()) << run.faults()[0];
    before = run.steps().size();
    const RunLock lock(folder);
    stale += lock.note().empty() ? 0 : 1;
  }
  EXPECT_GT(before, 2U);
  EXPECT_GT(stale, 0);
  RunFolder run(folder);
  append(run, "plan", 1);  // and goes on; what was killed leaves nothing behind for long
  EXPECT_TRUE(RunFolder(folder).faults().empty());
}

TEST(RunLock, RefusesASecondProcessByTheNumberOfTheFirst) {
  const test::TemporaryFolder temporary;
  std::string said;
  {
    const RunLock first(temporary.path());
    EXPECT_EQ(first.note(), "");
    try {
      const RunLock second(temporary.path());
    } catch (const InputError& error) {
      said = error.what();
    }
  }
  EXPECT_NE(said.find("is being changed by process " + std::to_string(getpid()) + " on "), std::string::npos) << said;
  const RunLock again(temporary.path());  // given back
  EXPECT_EQ(again.note(), "");
}

TEST(RunLock, TakesOverWhatADeadProcessHeld) {
  const test::TemporaryFolder temporary;
  const pid_t child = in_a_process([&] {
    const RunLock lock(temporary.path());
    kill(getpid(), SIGKILL);
    return 0;
  });
  end_of(child);
  const RunLock lock(temporary.path());
  EXPECT_NE(lock.note().find("process " + std::to_string(child) + " on "), std::string::npos) << lock.note();
}

}  // namespace
}  // namespace dwell

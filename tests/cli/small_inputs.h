#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/formats/map_io.h"
#include "tests/cli/program_run.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell::test {

/// The words of a command line.
using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The names of what is in a folder.
inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// A folder with a map and a spot as a user has them: plain matrices that say nothing of their pitch (0.5 mm).
struct SmallInputs {
  TemporaryFolder folder;

  SmallInputs() {
    std::string map, tif;
    for (int r = 0; r < 22; ++r) {
      for (int c = 0; c < 30; ++c)
        map += std::to_string(15.0 * std::sin(0.2 * c) * std::cos(0.15 * r) + 0.05 * r * c) + (c < 29 ? "," : "\n");
    }
    for (int r = -6; r <= 6; ++r) {
      for (int c = -6; c <= 6; ++c)
        tif += std::to_string(10.0 * std::exp(-0.09 * (r * r + c * c))) + (c < 6 ? "," : "\n");
    }
    folder.file("map.csv", map);
    folder.file("tif.csv", tif);
  }

  /// Arguments of a plan that is done in a fraction of a second, under sanitizers too: without the search of the time
  /// price. `more` replaces options or comes after them.
  static std::vector<std::string> plan(const std::vector<std::string>& more = {}) {
    const std::vector<std::pair<std::string, std::string>> usual{
        {"--map", "map.csv"},   {"--map-pixel", "0.5"}, {"--tif", "tif.csv"},
        {"--tif-pixel", "0.5"}, {"--threads", "1"},     {"--path", "raster:pitch=1,overrun=2"},
        {"--time-price", "0"},  {"--out", "plan"}};
    std::vector<std::string> words{"plan"};
    const auto tif = std::find(more.begin(), more.end(), "--tif");
    const bool formula = tif != more.end() && tif + 1 != more.end() && (tif + 1)->find(':') != std::string::npos;
    for (const auto& [flag, value] : usual) {
      if (formula && flag == "--tif-pixel") continue;  // of a file
      if (std::find(more.begin(), more.end(), flag) == more.end()) words.insert(words.end(), {flag, value});
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Starts a plan of seconds of solving (rough, without smoothness, off the lattice) into plan/ and comes back when it
  /// solves. Its map, plan-rough.npy, is removed by remove_long_plan().
  std::unique_ptr<ProgramRun> start_long_plan() const {
    HeightMap rough(Grid{1000, 1000, 0.1, 0.1, {}});
    unsigned noise = 1;
    for (double& z : rough.values) z = static_cast<double>((noise = noise * 1664525u + 1013904223u) >> 16) / 655.36;
    write_map(*this / "plan-rough.npy", rough);
    auto run = std::make_unique<ProgramRun>(
        folder.path(), std::vector<std::string>{"plan", "--map", "plan-rough.npy", "--map-pixel", "0.1", "--tif",
                                                "gaussian:peak=10,fwhm=1,radius=1.5", "--path",
                                                "raster:pitch=0.3,angle=10", "--smoothness", "0", "--time-price", "0",
                                                "--solver", "projected-cg", "--threads", "1", "--out", "plan"});
    while (!run->ended() && run->err().find("solve:") == std::string::npos) usleep(20'000);
    return run;
  }
  void remove_long_plan() const {
    for (const char* name : {"plan-rough.npy", "plan-rough.npy.json"}) std::filesystem::remove(*this / name);
  }

  /// The exit code of the program with arguments, redirections and `before` (limits) as a shell takes them, in the
  /// folder. What it says goes to said.txt unless redirected.
  int exit_of(const std::string& words, const std::string& before = "") const {
    const std::string command =
        "cd '" + folder.path().string() + "' && exec 2>said.txt; " + before + "'" + DWELL_PROGRAM + "' " + words;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// The words of plan() as a shell takes them.
  static std::string plan_for_shell(const std::vector<std::string>& more = {}) {
    std::string words;
    for (const std::string& word : plan(more)) words += "'" + word + "' ";
    return words;
  }

  ProgramResult run(const std::vector<std::string>& arguments) const { return run_program(folder.path(), arguments); }
  std::filesystem::path operator/(const std::string& name) const { return folder.path() / name; }
};

}  // namespace dwell::test

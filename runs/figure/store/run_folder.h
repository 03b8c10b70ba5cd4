#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runs/base/output_folder.h"

namespace dwell {

/// A file of a step, by its name within the step's folder.
struct StepFile {
  std::string name;
  std::string sha256;
  std::uintmax_t bytes = 0;
};

/// A step of a figure run: a folder that appeared whole and is never changed again. Its step.json says which kind of
/// step it is, lists all other files with their hashes, and names the hash of the step.json before it: the steps are a
/// chain, in which nothing can be changed, left out or put between without its being seen.
struct RunStep {
  int number = 0;      // 1, 2, ...
  std::string kind;    // "new", "plan", "measured", ...
  int iteration = 0;   // 0 before the first plan
  std::string folder;  // name within the run: "02-plan-1"
  std::vector<StepFile> files;
  nlohmann::ordered_json content;  // what the step says of itself
  std::string sha256;              // of its step.json
};

/// The folder of a figure run (docs/formats.md). Reading needs no lock: a step is there whole or not at all.
class RunFolder {
 public:
  /// Opens a run. Reads every step.json and checks the chain of their hashes; the other files are left to faults().
  /// Throws InputError naming the folder for one that is no run, and for the first step that does not continue the
  /// chain. Cost: O(files listed), without reading them.
  explicit RunFolder(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<RunStep>& steps() const { return steps_; }
  std::filesystem::path path_of(const RunStep& step) const { return folder_ / step.folder; }

  const RunStep& step(int number) const { return steps_.at(static_cast<std::size_t>(number) - 1); }
  /// Where the next step will be, if it is of this kind.
  std::filesystem::path path_of_next(const std::string& kind, int iteration) const;

  /// Writes the files of a step into its folder, and gives what the step says of itself.
  using Write = std::function<nlohmann::ordered_json(const OutputFolder& folder)>;
  /// Adds a step: `write` fills its folder, then its step.json is made, and the folder gets its name in one step of the
  /// file system. Throws what `write` throws, InputError where the disk is full or read-only; the run is then as
  /// before. The caller holds the run's lock.
  const RunStep& append(const std::string& kind, int iteration, const Write& write);

  /// What does not agree with the hashes: a file that is changed, missing, or not listed; a sentence each, naming it.
  /// Empty if all is as it was written. Cost: reads everything.
  std::vector<std::string> faults() const;
  /// The same of one step.
  std::vector<std::string> faults_of(const RunStep& step) const;
  /// Throws InputError with the first fault of a step that is to be used.
  void require_unchanged(const RunStep& step) const;

 private:
  std::filesystem::path folder_;
  std::vector<RunStep> steps_;
};

/// Makes the folder of a new run with its first step, whole or not at all. Throws InputError as OutputFolder: what is
/// there is never replaced.
RunFolder make_run_folder(const std::filesystem::path& folder, const RunFolder::Write& write);

}  // namespace dwell

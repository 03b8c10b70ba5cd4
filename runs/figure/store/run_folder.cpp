#include "runs/figure/store/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/counted.h"
#include "core/base/descriptor.h"
#include "core/base/errors.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kStepFile = "step.json";
constexpr const char* kFirstKind = "new";
constexpr int kRunSchema = 1;

std::string folder_name(int number, const std::string& kind, int iteration) {
  return iteration > 0 ? fmt::format("{:02}-{}-{}", number, kind, iteration) : fmt::format("{:02}-{}", number, kind);
}

/// The number with which the name of a step's folder begins; nothing for names that no step has.
std::optional<int> number_of_step(const std::string& name) {
  const std::size_t dash = name.find('-');
  if (dash == std::string::npos || dash < 2 || dash > 6) return {};
  const std::string rest = name.substr(dash + 1), kind = rest.substr(0, rest.find('-'));
  const bool is_word =
      !kind.empty() && std::all_of(kind.begin(), kind.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  const std::string last = kind.size() < rest.size() ? rest.substr(kind.size() + 1) : "0";
  const bool is_number =
      !last.empty() && std::all_of(last.begin(), last.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_word || !is_number) return {};
  int number = 0;
  for (const char c : name.substr(0, dash)) {
    if (c < '0' || c > '9') return {};
    number = 10 * number + (c - '0');
  }
  return number > 0 ? std::optional(number) : std::nullopt;
}

/// All files below a folder, but for step.json, by their names within it, sorted.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    std::string name = entry.path().lexically_relative(folder).string();
    if (name != kStepFile) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Tells the system to bring a file or folder to the disk. What it answers is no fault of the run: the step is as whole
/// as the file system keeps it.
void bring_to_disk(const fs::path& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() >= 0 && fsync(file.number()) != 0 && errno == EIO)
    throw InputError(fmt::format("{}: cannot be brought to the disk: {}", path.string(), std::strerror(errno)));
}

Json json_of_step(const RunStep& step, const std::string& previous) {
  Json files = Json::array();
  for (const StepFile& file : step.files)
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return {{"schema", kRunSchema},        {"version", version()}, {"step", step.number}, {"kind", step.kind},
          {"iteration", step.iteration}, {"previous", previous}, {"files", files},      {"content", step.content}};
}

/// Fills a step's folder and closes it with its step.json.
RunStep write_step(RunStep step, const std::string& previous, const OutputFolder& folder,
                   const RunFolder::Write& write) {
  step.content = write(folder);
  const fs::path place = folder.path("");
  for (const std::string& name : files_below(place)) {
    bring_to_disk(place / name);
    step.files.push_back({name, sha256_of_file(place / name), fs::file_size(place / name)});
  }
  const std::string text = json_text(json_of_step(step, previous));
  folder.write(kStepFile, text);
  bring_to_disk(place / kStepFile);
  step.sha256 = sha256_of(text);
  return step;
}

RunStep read_step(const fs::path& run, const std::string& name, int number, const std::string& previous) {
  const fs::path file = run / name / kStepFile;
  const auto fail = [&](const std::string& why) { throw InputError(fmt::format("{}: {}", file.string(), why)); };
  const std::string text = read_whole_file(file);
  RunStep step;
  try {
    const Json json = Json::parse(text);
    if (const int schema = json.at("schema"); schema != kRunSchema)
      fail(fmt::format("schema = {}; this version reads {}", schema, kRunSchema));
    step = {json.at("step"), json.at("kind"), json.at("iteration"), name, {}, json.at("content"), sha256_of(text)};
    for (const Json& entry : json.at("files"))
      step.files.push_back({entry.at("name"), entry.at("sha256"), entry.at("bytes")});
    if (step.number != number) fail(fmt::format("step = {}; its place is {}", step.number, number));
    if (const std::string own = folder_name(step.number, step.kind, step.iteration); own != name)
      fail(fmt::format("its folder is called '{}'; required {}", name, own));
    if (json.at("previous") != previous)
      fail("the step before it is another than when it was made: previous and the hash of that step.json differ");
  } catch (const nlohmann::json::exception& error) {
    fail(fmt::format("no step of a figure run: {}", error.what()));
  }
  return step;
}

const ResultFiles& files_of_a_step() {
  static const ResultFiles kFiles{"step of a figure run", kStepFile, {}, {}, nullptr};
  return kFiles;
}

}  // namespace

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)) {
  std::map<int, std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    const std::string name = entry.path().filename().string();
    const std::optional<int> number = number_of_step(name);
    if (!number || !entry.is_directory()) continue;
    if (const auto [at, is_new] = names.emplace(*number, name); !is_new)
      throw InputError(fmt::format("{}: two steps {}: '{}' and '{}'", folder_.string(), *number, at->second, name));
  }
  if (error) throw InputError(fmt::format("{}: cannot be read as a run: {}", folder_.string(), error.message()));
  if (names.empty() || names.begin()->first != 1) {
    throw InputError(fmt::format("{}: no figure run (it has no first step, 01-{}); make one by dwell figure new",
                                 folder_.string(), kFirstKind));
  }
  std::string previous;
  for (const auto& [number, name] : names) {
    const int expected = static_cast<int>(steps_.size()) + 1;
    if (number != expected) {
      throw InputError(fmt::format("{}: step {} is missing; '{}' follows '{}'", folder_.string(), expected, name,
                                   steps_.empty() ? "" : steps_.back().folder));
    }
    steps_.push_back(read_step(folder_, name, number, previous));
    previous = steps_.back().sha256;
  }
}

fs::path RunFolder::path_of_next(const std::string& kind, int iteration) const {
  return folder_ / folder_name(static_cast<int>(steps_.size()) + 1, kind, iteration);
}

const RunStep& RunFolder::append(const std::string& kind, int iteration, const Write& write) {
  RunStep step;
  step.number = static_cast<int>(steps_.size()) + 1;
  step.kind = kind;
  step.iteration = iteration;
  step.folder = folder_name(step.number, kind, iteration);
  OutputFolder folder(folder_ / step.folder, files_of_a_step());
  step = write_step(std::move(step), steps_.back().sha256, folder, write);
  folder.commit();
  bring_to_disk(folder_);
  steps_.push_back(std::move(step));
  return steps_.back();
}

std::vector<std::string> RunFolder::faults() const {
  std::vector<std::string> faults;
  for (const RunStep& step : steps_) {
    const std::vector<std::string> of_step = faults_of(step);
    faults.insert(faults.end(), of_step.begin(), of_step.end());
  }
  return faults;
}

std::vector<std::string> RunFolder::faults_of(const RunStep& step) const {
  std::vector<std::string> faults;
  {
    const fs::path place = path_of(step);
    std::set<std::string> listed;
    for (const StepFile& file : step.files) {
      listed.insert(file.name);
      const std::string name = (fs::path(step.folder) / file.name).string();
      std::error_code error;
      if (!fs::is_regular_file(place / file.name, error)) {
        faults.push_back(fmt::format("{}: is missing", name));
      } else if (sha256_of_file(place / file.name) != file.sha256) {
        faults.push_back(fmt::format("{}: is another than when it was written ({} of {} bytes)", name,
                                     fs::file_size(place / file.name, error), file.bytes));
      }
    }
    for (const std::string& name : files_below(place)) {
      if (!listed.contains(name))
        faults.push_back(
            fmt::format("{}: was not there when the step was written", (fs::path(step.folder) / name).string()));
    }
  }
  return faults;
}

void RunFolder::require_unchanged(const RunStep& step) const {
  const std::vector<std::string> faults = faults_of(step);
  if (!faults.empty()) {
    throw InputError(fmt::format("{}: {}; a run is planned and measured from what it was made of (dwell figure check)",
                                 folder_.string(), faults.front()));
  }
}

RunFolder make_run_folder(const fs::path& folder, const RunFolder::Write& write) {
  static const ResultFiles kNothing{"figure run that is not begun", kStepFile, {}, {}, nullptr};
  std::error_code error;
  if (fs::exists(folder / folder_name(1, kFirstKind, 0), error)) {
    throw InputError(
        fmt::format("{}: is a figure run already, and is never replaced; give another folder", folder.string()));
  }
  OutputFolder whole(folder, kNothing);
  {
    OutputFolder first(whole.path(folder_name(1, kFirstKind, 0)), files_of_a_step());
    RunStep step;
    step.number = 1;
    step.kind = kFirstKind;
    write_step(std::move(step), "", first, write);
    first.commit();
  }
  whole.commit();
  return RunFolder(folder);
}

}  // namespace dwell

#include "runs/figure/store/kept_inputs.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "core/base/errors.h"
#include "core/formats/map_name.h"
#include "core/formats/npy_sidecar.h"
#include "runs/job/job_file.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

void copy_into_run(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::copy_file(from, to, error);
  if (error) throw InputError(fmt::format("{}: cannot be copied into the run: {}", from.string(), error.message()));
}

/// Copies files into a folder, each once, and knows their names there.
class Copies {
 public:
  explicit Copies(const OutputFolder& folder) : folder_(folder) {}

  /// The name in the folder of the copy of a file, which may be named with an array in it.
  std::string keep(const std::string& key, const std::string& file) {
    const MapName name = split_map_name(file);
    std::error_code none;
    const std::string place = fs::weakly_canonical(name.file, none).string();
    auto found = names_.find(place);
    if (found == names_.end()) found = names_.emplace(place, copied(key, name.file)).first;
    return name.inside.empty() ? found->second : found->second + ":" + name.inside;
  }

 private:
  std::string copied(const std::string& key, const fs::path& file) {
    const std::string folder = "inputs/" + key;
    std::string name = fmt::format("{}/{}", folder, file.filename().string());
    for (int number = 2; !taken_.insert(name).second; ++number)
      name = fmt::format("{}/{}-{}", folder, number, file.filename().string());
    copy_into_run(file, folder_.path(name));
    const fs::path sidecar = npy_sidecar_name(file);
    std::error_code none;
    if (file.extension() == ".npy" && fs::exists(sidecar, none))
      copy_into_run(sidecar, npy_sidecar_name(folder_.path(name)));
    return name;
  }

  const OutputFolder& folder_;
  std::map<std::string, std::string> names_;
  std::set<std::string> taken_;
};

JobOptions renamed(JobOptions options, const std::string& only,
                   const std::function<std::string(const std::string& key, const std::string& file)>& name) {
  for (const JobOptionRecord& record : job_option_table()) {
    if (!record.key.starts_with(only) || record.key == "out") continue;
    const std::string value = record.get(options), source = "--" + record.flag;
    const std::string now = renamed_option(
        record, value, [&](const std::string& file) { return name(record.key, file); }, source);
    if (now != value) set_job_option(options, record, now, source);
  }
  return options;
}

}  // namespace

JobOptions keep_inputs(JobOptions options, const OutputFolder& folder, const std::string& only) {
  Copies copies(folder);
  return renamed(std::move(options), only,
                 [&](const std::string& key, const std::string& file) { return copies.keep(key, file); });
}

std::string keep_file(const fs::path& file, const std::string& key, const OutputFolder& folder) {
  return Copies(folder).keep(key, file.string());
}

JobOptions options_seen_from(JobOptions options, const fs::path& from, const fs::path& to) {
  return renamed(std::move(options), "", [&](const std::string&, const std::string& file) {
    const fs::path place = (from / file).lexically_normal();
    if (to.empty() || place.is_absolute()) return place.string();
    return fs::relative(place, to).string();
  });
}

}  // namespace dwell

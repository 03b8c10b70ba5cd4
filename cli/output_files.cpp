#include "cli/output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "cli/places.h"
#include "cli/result_kinds.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/staged_files.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_io.h"
#include "core/formats/map_name.h"
#include "core/formats/npy_sidecar.h"
#include "runs/drawing/figure_format.h"

namespace dwell::cli {
namespace {

namespace fs = std::filesystem;

/// A file on disk and what messages call it.
struct Place {
  std::string name;
  fs::path file;
};

[[noreturn]] void refuse(const OutputFile& output, const std::string& why) {
  throw InputError(fmt::format("{} '{}': {}", output.option, output.file, why));
}

std::string extension_of(const fs::path& file) { return lower_case(file.extension().string()); }

void check_extension(const OutputFile& output) {
  const std::string extension = extension_of(output.file);
  const auto require = [&](bool accepted, const std::string& what) {
    if (!accepted) refuse(output, fmt::format("extension '{}'; accepted: {}", extension, what));
  };
  switch (output.kind) {
    case OutputFile::Kind::Png:
      return require(extension == ".png", ".png");
    case OutputFile::Kind::Figure:
      return require(extension == ".png" || extension == ".svg" || extension == ".pdf", figure_extensions());
    case OutputFile::Kind::Json:
      return require(extension == ".json", ".json");
    case OutputFile::Kind::Machine:
      return require(extension == ".toml", ".toml");
    case OutputFile::Kind::Table:
      return require(extension == ".csv", ".csv");
    case OutputFile::Kind::Map:
      return require(map_writer_of(extension) != nullptr, written_map_extensions());
  }
}

void check_place(const OutputFile& output) {
  const fs::path file(output.file);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown)) refuse(output, fmt::format("there is no folder '{}'", folder.string()));
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(output, fmt::format("the folder '{}' cannot be written: {}", folder.string(),
                               std::generic_category().message(errno)));
  }
  const fs::file_status status = fs::status(file, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    refuse(output, fs::is_directory(status) ? "is a folder; a file is required"
                                            : "is no regular file; one, or a new name, is required");
  }
}

/// The file and, of an NPY array, its sidecar.
void add_places(std::vector<Place>& places, const std::string& name, const fs::path& file) {
  places.push_back({name, file});
  if (extension_of(file) == ".npy") places.push_back({"the sidecar of " + name, npy_sidecar_name(file)});
}

/// A folder that holds a result stays as it was written: its files belong together, and it can be replaced by the next
/// as long as nothing else is in it.
void keep_results_whole(const OutputFile& output, const Place& place) {
  const fs::path folder = place.file.has_parent_path() ? place.file.parent_path() : fs::path(".");
  for (const ResultFiles* kind : kinds_of_results()) {
    if (!is_result(folder, *kind)) continue;
    if (kind->has(place.file.filename().string())) {
      refuse(output,
             fmt::format("is a file of the earlier {} in '{}', which would then say what it is not; give another "
                         "name and folder",
                         kind->kind, folder.string()));
    }
    refuse(output, fmt::format("'{}' holds an earlier {}, which could then no longer be replaced; give another folder",
                               folder.string(), kind->kind));
  }
}

}  // namespace

void check_output_files(const std::vector<OutputFile>& outputs, const std::vector<ReadFile>& read) {
  std::vector<Place> taken;
  for (const ReadFile& r : read) {
    if (!r.file.empty()) add_places(taken, r.name + ", which is read", split_map_name(r.file).file);
  }
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    check_extension(output);
    check_place(output);
    std::vector<Place> places;
    add_places(places, output.option, output.file);
    for (const Place& mine : places) {
      keep_results_whole(output, mine);
      for (const Place& other : taken) {
        if (same_file(mine.file, other.file)) {
          refuse(output,
                 fmt::format("'{}' is the same file as {}; another name is required", mine.file.string(), other.name));
        }
      }
    }
    taken.insert(taken.end(), places.begin(), places.end());
  }
}

void PendingFiles::add_map(const std::string& file, const HeightMap& map) {
  map_file_ = file;
  map_ = &map;
}

void PendingFiles::write() const {
  StagedFiles files;
  if (!map_file_.empty()) stage_map(map_file_, *map_, files);
  for (const Other& other : others_) files.add(other.file, other.bytes);
  files.put_in_place();
}

}  // namespace dwell::cli

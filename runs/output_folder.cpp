#include "runs/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/errors.h"
#include "core/whole_file.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

/// An absolute path without a trailing separator, so that its parent is the folder that holds it.
fs::path normal(const fs::path& target) {
  if (target.empty()) throw InputError("--out: required; the folder for the plan");
  fs::path path = fs::absolute(target).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path;
}

void check_target(const fs::path& target, const fs::path& shown) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw InputError(fmt::format("--out: '{}' is a file; a folder is required", shown.string()));
  if (fs::is_empty(target, error) || fs::exists(target / "summary.json", error)) return;
  throw InputError(fmt::format(
      "--out: '{}' holds files that are not a plan (no summary.json); give an empty or a new folder", shown.string()));
}

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw InputError(fmt::format("--out: cannot write '{}': {}", target.string(), reason));
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target) : target_(normal(target)) {
  check_target(target_, target);
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) refuse(target, error.message());
  temporary_ = target_.parent_path() / fmt::format(".{}.tmp-{}", target_.filename().string(), getpid());
  fs::remove_all(temporary_, error);
  fs::create_directory(temporary_, error);
  if (error) refuse(target, error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void OutputFolder::write(const std::string& name, std::string_view bytes) const { write_whole_file(path(name), bytes); }

void OutputFolder::commit() {
  if (rename(temporary_.c_str(), target_.c_str()) == 0) return;  // no earlier result, or an empty folder
  if (errno != EEXIST && errno != ENOTEMPTY) refuse(target_, std::strerror(errno));
  // Exchanged in one step: at no moment is there neither the old result nor the new one. The old one is then removed.
  if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0)
    refuse(target_, std::strerror(errno));
}

}  // namespace dwell

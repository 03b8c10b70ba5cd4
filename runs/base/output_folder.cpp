#include "runs/base/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include "core/base/errors.h"
#include "core/base/temporary_name.h"
#include "core/base/whole_file.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_out(const fs::path& value, const std::string& accepted, const std::string& why) {
  throw InputError("out", value.string(), accepted, "`out`: " + why);
}

/// An absolute path without links or a trailing separator, so that its parent is the folder that holds it.
fs::path normal(const fs::path& target, const ResultFiles& files) {
  if (target.empty())
    refuse_out("", fmt::format("the folder for the {}", files.kind),
               fmt::format("required; the folder for the {}", files.kind));
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(target), error);
  if (error) path = fs::absolute(target).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path;
}

/// What shows that a folder is not an earlier result; empty if it is one.
std::string foreign_entry(const fs::path& target, const ResultFiles& files) {
  bool whole = false;
  std::error_code error;
  for (fs::directory_iterator entry(target, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    whole = whole || name == files.always;
    if (files.in_folders && entry->is_directory(error) && !entry->is_symlink(error)) {
      const std::string other = foreign_entry(entry->path(), *files.in_folders);
      if (other.empty()) continue;
      return fmt::format("in its folder '{}', {}", name, other);
    }
    if (!files.has(name) || !entry->is_regular_file(error)) return fmt::format("it holds '{}'", name);
  }
  if (error) return error.message();
  return whole ? "" : fmt::format("it holds no {}", files.always);
}

void check_target(const fs::path& target, const fs::path& shown, const ResultFiles& files) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    refuse_out(shown, "a folder", fmt::format("'{}' is a file; a folder is required", shown.string()));
  if (fs::is_empty(target, error)) return;
  const std::string other = foreign_entry(target, files);
  if (other.empty()) return;
  refuse_out(shown, "an empty or a new folder",
             fmt::format("'{}' is not an earlier {} ({}) and is left alone; give an empty or a new folder",
                         shown.string(), files.kind, other));
}

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  refuse_out(target, "a folder that can be written", fmt::format("cannot write '{}': {}", target.string(), reason));
}

}  // namespace

bool ResultFiles::has(std::string_view name) const {
  for (const auto& [begin, end] : numbered) {
    if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) continue;
    const std::string_view number = name.substr(begin.size(), name.size() - begin.size() - end.size());
    if (number.find_first_not_of("0123456789") == std::string_view::npos) return true;
  }
  if (name == always || std::find(others.begin(), others.end(), name) != others.end()) return true;
  const std::size_t dot = std::min(name.rfind('.'), name.size());
  const std::string_view extension = name.substr(dot);
  if (extension.size() > 1 && std::find(any_ending.begin(), any_ending.end(), name.substr(0, dot)) != any_ending.end())
    return true;
  return (extension == ".png" || extension == ".svg" || extension == ".pdf") &&
         std::find(figures.begin(), figures.end(), name.substr(0, dot)) != figures.end();
}

const ResultFiles& pareto_files() {
  static const ResultFiles kFiles{"pareto sweep", "pareto.json", {"pareto.csv"}, {"pareto"}, nullptr};
  return kFiles;
}

bool is_result(const fs::path& folder, const ResultFiles& files) { return foreign_entry(folder, files).empty(); }

void refuse_inside_result(const fs::path& target, const ResultFiles& files,
                          const std::vector<const ResultFiles*>& kinds) {
  const fs::path place = normal(target, files);
  for (fs::path above = place.parent_path(); above.has_relative_path(); above = above.parent_path()) {
    for (const ResultFiles* kind : kinds) {
      const bool one_of_many = kind->in_folders == &files && !kind->own_folders && above == place.parent_path();
      if (one_of_many || !is_result(above, *kind)) continue;
      refuse_out(
          target, "a folder outside of it",
          fmt::format("'{}' lies in '{}', which holds an earlier {} and could then no longer be replaced; give a "
                      "folder outside of it",
                      target.string(), above.string(), kind->kind));
    }
  }
}

OutputFolder::OutputFolder(const fs::path& target, const ResultFiles& files, MissingParents parents)
    : target_(normal(target, files)) {
  check_target(target_, target, files);
  made_parents_.make(target_.parent_path(),
                     parents == MissingParents::MakeAll ? std::numeric_limits<std::size_t>::max() : 1);
  unfinished_.emplace(UnfinishedOutput::Kind::Folder, [&] {
    try {
      TemporaryName name = make_temporary_folder(target_);
      held_ = std::move(name.held);
      return temporary_ = std::move(name.path);
    } catch (const std::system_error& error) {
      refuse(target, error.code().message());
    }
  });
}

void OutputFolder::write(const std::string& name, std::string_view bytes) const { write_whole_file(path(name), bytes); }

void OutputFolder::commit() {
  unfinished_->put_in_place(target_, [this] { exchange(); });
}

void OutputFolder::exchange() const {
  if (rename(temporary_.c_str(), target_.c_str()) == 0) return;  // no earlier result, or an empty folder
  if (errno != EEXIST && errno != ENOTEMPTY) refuse(target_, std::strerror(errno));
  // Exchanged in one step: at no moment is there neither the old result nor the new one. The old one is then removed.
  if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) refuse(target_, std::strerror(errno));
  // A file system that cannot exchange: the old result keeps a name at every moment, if not always its own.
  const fs::path old = temporary_.string() + ".old";
  if (rename(target_.c_str(), old.c_str()) != 0) refuse(target_, std::strerror(errno));
  if (rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int reason = errno;
    rename(old.c_str(), target_.c_str());
    refuse(target_, std::strerror(reason));
  }
  std::error_code ignored;
  fs::remove_all(old, ignored);
}

}  // namespace dwell

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/unfinished_output.h"
#include "runs/base/made_folders.h"

namespace dwell {

/// The files of a kind of result. A folder that holds nothing else, and the one that every such result has, is an
/// earlier result; any other file in it is the user's and not ours to remove.
struct ResultFiles {
  std::string_view kind;    // "plan"
  std::string_view always;  // in every result of the kind
  std::vector<std::string_view> others;
  std::vector<std::string_view> figures;    // without their extensions, which are .png, .svg or .pdf
  const ResultFiles* in_folders = nullptr;  // what folders in it may hold, of any name: a result of this kind each
  bool own_folders = false;                 // these are its own alone: none is made or replaced by itself
  /// Beginnings and ends of names with a number between: program_001.trj.
  std::vector<std::pair<std::string_view, std::string_view>> numbered{};
  std::vector<std::string_view> any_ending{};  // names without their endings, which may be any

  bool has(std::string_view name) const;
};
const ResultFiles& pareto_files();

/// Whether a folder holds an earlier result of the kind and nothing else.
bool is_result(const std::filesystem::path& folder, const ResultFiles& files);

/// Throws InputError if the target lies in a folder that holds a result of one of the kinds and, with the target in it,
/// would no longer be known as one: it could never be replaced. `files` are those of the target.
void refuse_inside_result(const std::filesystem::path& target, const ResultFiles& files,
                          const std::vector<const ResultFiles*>& kinds);

/// Which missing folders above a result are made.
enum class MissingParents {
  MakeOne,  // more than one is rather a slip of the pen
  MakeAll,
};

/// A folder of results that appears whole or not at all. Files go to a temporary folder beside the target; commit()
/// puts it in place in one step (an earlier result is exchanged with it and then removed); without commit() the
/// temporary folder is removed, with the parents that were made for it, and the target is as it was.
class OutputFolder {
 public:
  /// Throws InputError if the target is empty text, a file, a folder that holds anything but an earlier result
  /// of the kind, if more than `parents` allows is missing above it, or if its parent cannot be written. Checks before
  /// any work is done; creates the temporary folder. A link to a folder stays: what it points to is replaced.
  OutputFolder(const std::filesystem::path& target, const ResultFiles& files,
               MissingParents parents = MissingParents::MakeOne);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where files are until commit().
  std::filesystem::path path(const std::string& name) const { return temporary_ / name; }
  void write(const std::string& name, std::string_view bytes) const;
  void commit();

 private:
  void exchange() const;

  std::filesystem::path target_, temporary_;
  MadeFolders made_parents_;
  Descriptor held_;  // the mark that the temporary folder is work in progress
  std::optional<UnfinishedOutput> unfinished_;
};

}  // namespace dwell

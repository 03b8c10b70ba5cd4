#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dwell {

/// A folder of results that appears whole or not at all. Files go to a temporary folder beside the target; commit()
/// puts it in place in one step (an earlier result is exchanged with it and then removed); without commit() the
/// temporary folder is removed and the target is as it was.
class OutputFolder {
 public:
  /// Throws InputError if the target is empty text, a file, a folder that holds anything but an earlier result (known
  /// by its summary.json), or if its parent cannot be written. Checks before any work is done; creates the temporary
  /// folder.
  explicit OutputFolder(const std::filesystem::path& target);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where files are until commit().
  std::filesystem::path path(const std::string& name) const { return temporary_ / name; }
  void write(const std::string& name, std::string_view bytes) const;
  void commit();

 private:
  std::filesystem::path target_, temporary_;
};

}  // namespace dwell

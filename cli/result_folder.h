#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "cli/output_files.h"
#include "runs/base/output_folder.h"

namespace dwell::cli {

/// The folder of --out with its flag --parents, the same in every command that makes one.
class ResultFolder {
 public:
  ResultFolder() = default;
  ResultFolder(const ResultFolder&) = delete;  // the command line holds a reference to it
  ResultFolder& operator=(const ResultFolder&) = delete;

  void add_to(CLI::App& command);

  /// The folder `out` for a result of a kind. Throws InputError as OutputFolder does, if it lies in an earlier result
  /// of any kind (refuse_inside_result), and if it holds a file that is read: the folder is replaced whole, and the
  /// file would go with it.
  OutputFolder make(const std::string& out, const ResultFiles& files, const std::vector<ReadFile>& read) const;

 private:
  bool parents_ = false;
};

}  // namespace dwell::cli

#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "cli/output_files.h"
#include "runs/job/job_options.h"

namespace dwell::cli {

/// Command-line options made from the table of job options. A command names those it uses.
class JobArguments {
 public:
  /// Adds --job FILE as well, if `with_job`.
  JobArguments(CLI::App& command, const std::vector<std::string>& flags, bool with_job);

  /// The job file, if one is given, then what the command line says over it. Throws InputError.
  JobOptions options() const;
  /// What the command line says over other options, those of a plan for instance. Throws InputError.
  JobOptions options_over(JobOptions options) const;
  /// Whether a job file is given.
  bool has_file() const { return !job_.empty(); }
  /// The options that the command line gives.
  std::vector<const JobOptionRecord*> given() const;

  /// Throws InputError that names all of the flags whose option is not given, if these are two or more: whoever lacks
  /// one is told better by what reads it. Where one is missing, pitches that the files lack are named as well.
  /// `others` are missing besides: they are of the command alone.
  static void require(const JobOptions& options, const std::vector<std::string>& flags,
                      const std::vector<std::string>& others = {});

  /// The files that these options name for reading, the job file among them, as check_output_files takes them.
  std::vector<ReadFile> files_read(const JobOptions& options) const;

 private:
  struct Given {
    const JobOptionRecord* record;
    CLI::Option* option;
  };
  std::vector<Given> given_;
  std::string job_;
  bool takes_tools_ = false;
};

/// All flags of the table.
std::vector<std::string> every_flag();

}  // namespace dwell::cli

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runs/base/input_file.h"
#include "runs/job/job.h"
#include "runs/programs/program_template.h"

namespace dwell {

/// What a program of ours says in its header of how it was made (docs/formats.md). Empty for a program of other origin.
struct ProgramRecord {
  std::vector<InputFile> inputs;
  std::map<std::string, std::string> options;  // by job-file key; empty: none are stated (before version 0.3)
  std::string stated_hash;                     // record_hash of these as they were written; empty: not stated
};

/// Reads the header of a feed table or of G-code: the comments before all else, those that are no record skipped.
/// Throws InputError if the file cannot be read, or if an input is stated without its SHA-256.
/// `layout`: that of a program by a template; of one in upper case only the inputs are known.
ProgramRecord read_program_record(const std::filesystem::path& program, const ProgramTemplate* layout = nullptr);

/// The options that a program's header states, by job-file key: those that change its removal, or the map that it is
/// subtracted from. Options that are not given are left out.
std::vector<std::pair<std::string, std::string>> options_of_record(const JobOptions& options);

/// Which inputs are meant to be others than those that the program was made with.
struct OtherInputs {
  bool map = false, tif = false;
};

/// Whether inputs of this role only made the program, so that what it removes is compared without them: its path, its
/// machine, lines of G-code put into it.
bool is_of_program_alone(const std::string& role);

/// Compares the header of a program with the job that it is simulated on. Returns a sentence for each difference, also
/// if the header was changed after it was written. A map (or a map that a step of its preparation reads) or a removal
/// function that is another is refused unless it is meant. `compare_options`: also the options. Throws InputError
/// naming the program, both files and their SHA-256.
std::vector<std::string> differences_from_record(const ProgramRecord& record, const std::string& program,
                                                 const Job& job, const OtherInputs& meant, bool compare_options);

/// The first digits of a SHA-256, for people.
std::string short_hash(const std::string& sha256);

}  // namespace dwell

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/motion/program.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/gcode_reading.h"

namespace dwell {

/// What a machine program says beside its steps.
struct ProgramWriting {
  GcodeDialect dialect = GcodeDialect::G94;
  double lift_height_mm = 10.0;          // Z of lifted moves
  std::vector<std::string> header = {};  // comment lines; a format whose table names its inputs itself ignores them
};

/// What is known of a format of machine programs. One table of these records feeds the reader of programs, the files of
/// a plan's folder, the tests and the list of fuzz targets: a new format is its two files and its row (docs/adding.md).
struct ProgramFormat {
  std::string name;   // as messages list it
  std::string file;   // in a plan's folder: "feed.csv"
  std::string about;  // one line
  std::string fuzz;   // its target: tests/fuzz/reader_FUZZ.cpp with seeds/FUZZ
  bool is_gcode;      // what a G-code program leaves to its controller may be given for reading it
  /// Whether a file is of this format, by its text from the first character on that is not blank.
  bool (*recognise)(std::string_view text);
  /// Reads the text of a file; `file` is the name for messages. Throws InputError naming file, line and what is
  /// accepted.
  Program (*read)(std::string_view text, const std::string& file, const GcodeReading& reading,
                  const Progress& progress);
  /// The bytes of the file. Throws InputError for an option out of range.
  std::string (*write)(const FeedTable& table, const ProgramWriting& writing, const Progress& progress);
};

/// Every format, in the order in which a file is tried.
const std::vector<ProgramFormat>& program_formats();

/// The format of a text, null if none recognises it. Leading blanks do not count.
const ProgramFormat* program_format_of(std::string_view text);

/// A plan's program in one format.
struct WrittenProgram {
  std::string file;  // its name in the plan's folder
  std::string bytes;
};

/// The plan's program in every format, in the order of the table.
std::vector<WrittenProgram> written_programs(const FeedTable& table, const ProgramWriting& writing, int threads = 1,
                                             const Progress& progress = {});

}  // namespace dwell

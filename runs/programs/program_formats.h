#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/gcode_reading.h"
#include "runs/programs/gcode_style.h"
#include "runs/programs/stretches.h"

namespace dwell {

/// What a machine program says beside its steps.
struct ProgramWriting {
  GcodeDialect dialect = GcodeDialect::G94;
  double lift_height_mm = 10.0;          // Z of lifted moves
  std::vector<std::string> header = {};  // comment lines; a format whose table names its inputs itself ignores them
  GcodeStyle gcode{};                    // of G-code alone
  /// Whose letters the axes have, of whose steps places and times are multiples, and whose speeds rounded moves keep.
  std::optional<Machine> machine{};
};

/// A plan's program: as a table of dwell and feeds, and as the motion that is scheduled.
struct ProgramToWrite {
  FeedTable table;
  /// In the order of the run, lifted moves included: every step with its time and, if it moves, the velocities at its
  /// ends. Nothing for a plan without a machine.
  std::optional<Program> motion = {};
  /// The motion is a schedule of speeds that feeds cannot say: formats that need no motion are not written.
  bool speeds_alone = false;
};

/// What is known of a format of machine programs. One table of these records feeds the reader of programs, the files of
/// a plan's folder, the tests and the list of fuzz targets: a new format is its two files and its row (docs/adding.md).
struct ProgramFormat {
  std::string name;   // as messages list it
  std::string file;   // in a plan's folder: "feed.csv"; empty of a format that is only read, or part of another
  std::string about;  // one line
  std::string fuzz;   // its target: tests/fuzz/reader_FUZZ.cpp with seeds/FUZZ
  bool is_gcode;      // what a G-code program leaves to its controller may be given for reading it
  std::string word;   // as --export names it; empty: part of every plan
  bool needs_motion;  // it is written from the scheduled motion, which takes a machine
  bool takes_start;   // where the program begins may be given for reading it
  bool in_frame;      // its places are those of the program's frame, and not of the part
  /// Whether a file is of this format, by its text from the first character on that is not blank.
  bool (*recognise)(std::string_view text);
  /// Reads the text of a file; `file` is the name for messages. Throws InputError naming file, line and what is
  /// accepted.
  Program (*read)(std::string_view text, const std::string& file, const GcodeReading& reading,
                  const Progress& progress);
  /// The files, the one named above first. Throws InputError for an option out of range. Null of a format without file.
  std::vector<WrittenProgram> (*write)(const ProgramToWrite& program, const ProgramWriting& writing,
                                       const Progress& progress);
};

/// Every format, in the order in which a file is tried.
const std::vector<ProgramFormat>& program_formats();

/// The format of a text, null if none recognises it. Leading blanks do not count.
const ProgramFormat* program_format_of(std::string_view text);

/// The formats of a list like "xps-trj,pmac", by their words, each once in the order of the table; "none" is empty.
/// Throws InputError for a word that is none.
std::vector<std::string> parse_exports(std::string_view text);
std::string exports_text(const std::vector<std::string>& exports);
/// The words that parse_exports takes: "pvt-csv, pvt-json, ...".
std::string export_words();

/// The first of these formats that is written from the scheduled motion; empty if none is.
std::string export_that_needs_motion(const std::vector<std::string>& exports);

/// The first of these formats that is written from the scheduled motion with the places of the part; empty if none is.
std::string export_without_frame(const std::vector<std::string>& exports);

/// The first of these formats whose blocks say the feed at their end, g293 or flin; empty if none is.
std::string export_of_end_feeds(const std::vector<std::string>& exports);

/// Whether one of these formats says feeds that are linear over the path, flin.
bool has_export_over_path(const std::vector<std::string>& exports);

/// The plan's program in every format that is part of every plan, and those of `exports`, in the order of the table.
/// Throws std::logic_error for one that needs the motion where there is none.
std::vector<WrittenProgram> written_programs(const ProgramToWrite& program, const ProgramWriting& writing,
                                             const std::vector<std::string>& exports = {}, int threads = 1,
                                             const Progress& progress = {});

}  // namespace dwell

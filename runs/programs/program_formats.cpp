#include "runs/programs/program_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/side_by_side.h"
#include "core/base/text_lines.h"
#include "core/base/whole_file.h"
#include "core/base/word_list.h"
#include "core/formats/hdf5_map.h"
#include "paths/feed/end_feed_blocks.h"
#include "paths/feed/exported_motion.h"
#include "paths/feed/path_linear.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_parts.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/pmac_program.h"
#include "runs/programs/pvt_csv.h"
#include "runs/programs/pvt_hdf5.h"
#include "runs/programs/pvt_json.h"
#include "runs/programs/speed_gcode.h"
#include "runs/programs/speed_gcode_reader.h"
#include "runs/programs/xps_trajectory.h"

namespace dwell {
namespace {

bool is_feed_table(std::string_view text) { return text.starts_with("# dwell") || text.starts_with("sequence,"); }

Program read_table(std::string_view text, const std::string& file, const GcodeReading&, const Progress& progress) {
  Program program = program_of(parse_feed_table(text, file, progress));
  program.file = file;
  if (program.rapid_length > 0.0) {
    program.notes.emplace_back("the table says no height of its lifts: the ways up and down take their time besides");
  }
  return program;
}

std::vector<WrittenProgram> write_table(const ProgramToWrite& program, const ProgramWriting&,
                                        const Progress& progress) {
  return {{"feed.csv", feed_table_text(program.table, progress)}};
}

/// Whether a text begins with a comment, a % or a word: a letter and a number.
bool is_gcode(std::string_view text) {
  if (text.empty() || is_pmac_program(text)) return false;
  for (const SpeedDialect dialect : {SpeedDialect::G293, SpeedDialect::Flin}) {
    if (is_speed_gcode(text, dialect)) return false;
  }
  if (std::string_view("%(;/").find(text.front()) != std::string_view::npos) return true;
  const std::size_t number = text.find_first_not_of(" \t", 1);
  const bool letter = (text.front() >= 'A' && text.front() <= 'Z') || (text.front() >= 'a' && text.front() <= 'z');
  return letter && number != std::string_view::npos &&
         std::string_view("0123456789.+-").find(text[number]) != std::string_view::npos;
}

GcodeOptions gcode_options(const ProgramToWrite& program, const ProgramWriting& writing) {
  GcodeOptions options;
  options.dialect = writing.dialect;
  options.lift_height_mm = writing.lift_height_mm;
  options.max_feed_mm_per_min = program.table.max_feed_mm_per_min;
  options.header = writing.header;
  options.style = writing.gcode;
  options.machine = writing.machine;
  return options;
}

std::vector<WrittenProgram> write_gcode(const ProgramToWrite& program, const ProgramWriting& writing,
                                        const Progress& progress) {
  const GcodeOptions options = gcode_options(program, writing);
  const Program steps = program_of(program.table);
  std::vector<WrittenProgram> files{{"program.nc", gcode_text(steps, options, progress)}};
  const std::string& text = files.front().bytes;
  const std::size_t most = writing.gcode.max_lines;
  if (most > 0 && static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) > most) {
    for (WrittenProgram& part : written_gcode_parts(steps, options, most, program.table, progress))
      files.push_back(std::move(part));
  }
  return files;
}

template <SpeedDialect dialect>
bool is_speeds(std::string_view text) {
  return is_speed_gcode(text, dialect);
}

template <SpeedDialect dialect>
Program read_speeds(std::string_view text, const std::string& file, const GcodeReading& reading,
                    const Progress& progress) {
  return read_speed_gcode(text, file, dialect, reading, progress);
}

template <SpeedDialect dialect>
std::vector<WrittenProgram> write_speeds(const ProgramToWrite& program, const ProgramWriting& writing,
                                         const Progress& progress) {
  if (!program.motion) throw std::logic_error("a program of feeds at the ends of blocks needs the motion");
  std::vector<EndFeedBlock> blocks = blocks_of_motion(*program.motion, progress);
  if constexpr (dialect == SpeedDialect::Flin) {
    Machine machine = writing.machine.value_or(Machine{});
    machine.frame = program.table.frame;
    blocks = blocks_over_path(blocks, machine, least_piece_seconds(machine));
  }
  return {{dialect == SpeedDialect::G293 ? "g293.nc" : "flin.mpf",
           speed_gcode_text(dialect, blocks, program.table.frame, gcode_options(program, writing), progress)}};
}

PvtTable table_of_motion(const ProgramToWrite& program, const ProgramWriting& writing, const Progress& progress) {
  if (!program.motion) throw std::logic_error("a program of positions, velocities and times needs the motion");
  return pvt_table_of(*program.motion, progress, writing.machine ? pvt_steps_of(*writing.machine) : PvtSteps{});
}

Program read_csv(std::string_view text, const std::string& file, const GcodeReading&, const Progress& progress) {
  return program_of(parse_pvt_csv(text, file, progress), file);
}

std::vector<WrittenProgram> write_csv(const ProgramToWrite& program, const ProgramWriting& writing,
                                      const Progress& progress) {
  return {{"pvt.csv", pvt_csv_text(table_of_motion(program, writing, progress), program.table, progress)}};
}

Program read_json(std::string_view text, const std::string& file, const GcodeReading&, const Progress& progress) {
  return program_of(parse_pvt_json(text, file, progress), file);
}

std::vector<WrittenProgram> write_json(const ProgramToWrite& program, const ProgramWriting& writing,
                                       const Progress& progress) {
  return {{"pvt.json", pvt_json_text(table_of_motion(program, writing, progress), program.table, progress)}};
}

Program read_hdf5(std::string_view text, const std::string& file, const GcodeReading&, const Progress& progress) {
  return program_of(parse_pvt_hdf5(text, file, progress), file);
}

std::vector<WrittenProgram> write_hdf5(const ProgramToWrite& program, const ProgramWriting& writing,
                                       const Progress& progress) {
  return {{"pvt.h5", pvt_hdf5_bytes(table_of_motion(program, writing, progress), program.table)}};
}

/// The files that lie beside a list.
ReadBeside files_beside(const std::string& file) {
  return [&file](const std::string& name) { return read_whole_file(std::filesystem::path(file).parent_path() / name); };
}

Program read_parts(std::string_view text, const std::string& file, const GcodeReading& reading,
                   const Progress& progress) {
  return parse_gcode_part_list(text, file, reading, files_beside(file), progress);
}

template <StretchKind kind>
bool is_list(std::string_view text) {
  return is_stretch_list(text, kind);
}

template <StretchKind kind>
Program read_list(std::string_view text, const std::string& file, const GcodeReading& reading,
                  const Progress& progress) {
  return program_of(parse_stretch_list(text, file, kind, files_beside(file), progress, reading.letters), file);
}

template <StretchKind kind>
std::vector<WrittenProgram> write_list(const ProgramToWrite& program, const ProgramWriting& writing,
                                       const Progress& progress) {
  return written_stretches(kind, table_of_motion(program, writing, progress), program.table, progress,
                           writing.machine ? writing.machine->letters : AxisLetters{});
}

Program read_xps(std::string_view text, const std::string& file, const GcodeReading& reading,
                 const Progress& progress) {
  return program_of(parse_xps_trajectory(text, file, reading.start, progress), file);
}

Program read_pmac(std::string_view text, const std::string& file, const GcodeReading& reading,
                  const Progress& progress) {
  return program_of(parse_pmac_program(text, file, reading.start, progress, reading.letters), file);
}

/// Whether a plan with these exports has the format.
bool is_written(const ProgramFormat& format, const std::vector<std::string>& exports, bool speeds_alone) {
  if (format.write == nullptr || (speeds_alone && !format.needs_motion)) return false;
  return format.word.empty() || is_among(format.word, exports);
}

}  // namespace

const std::vector<ProgramFormat>& program_formats() {
  static const std::vector<ProgramFormat> kFormats{
      {"a feed table (first line \"# dwell ...\")", "feed.csv", "the dwell points in order, each with dwell and feed",
       "feed_table", false, "", false, false, false, is_feed_table, read_table, write_table},
      {"G-code (comments and words such as G1 X1.5)", "program.nc", "the same as G-code", "gcode", true, "", false,
       false, true, is_gcode, read_gcode, write_gcode},
      {"a PVT table (first line \"# pvt: ...\")", "pvt.csv", "times, places and velocities as text", "pvt_csv", false,
       "pvt-csv", true, false, false, is_pvt_csv, read_csv, write_csv},
      {"a PVT table as JSON (an object with \"pvt\")", "pvt.json", "times, places and velocities as JSON", "pvt_json",
       false, "pvt-json", true, false, false, is_pvt_json, read_json, write_json},
      {"a PVT table as HDF5 (data set /pvt)", "pvt.h5", "times, places and velocities as HDF5", "pvt_hdf5", false,
       "pvt-hdf5", true, false, false, is_hdf5, read_hdf5, write_hdf5},
      {"a list of XPS trajectories (first line \"# xps: ...\")", "xps.csv",
       "Newport XPS trajectories program_001.trj, ... and their list", "stretches", false, "xps-trj", true, false,
       false, is_list<StretchKind::XpsTrajectory>, read_list<StretchKind::XpsTrajectory>,
       write_list<StretchKind::XpsTrajectory>},
      {"a list of PMAC programs (first line \"# pmac: ...\")", "pmac.csv",
       "PMAC programs in PVT mode program_001.pmc, ... and their list", "stretches", false, "pmac", true, false, false,
       is_list<StretchKind::PmacProgram>, read_list<StretchKind::PmacProgram>, write_list<StretchKind::PmacProgram>},
      {"G-code with G293 (Beckhoff TwinCAT CNC)", "g293.nc",
       "G-code whose feed changes linearly over the time of a block", "g293", false, "g293", true, false, true,
       is_speeds<SpeedDialect::G293>, read_speeds<SpeedDialect::G293>, write_speeds<SpeedDialect::G293>},
      {"G-code with FLIN (Siemens 840D)", "flin.mpf", "G-code whose feed changes linearly over the way of a block",
       "flin", false, "flin", true, false, true, is_speeds<SpeedDialect::Flin>, read_speeds<SpeedDialect::Flin>,
       write_speeds<SpeedDialect::Flin>},
      {"a list of parts of a G-code program (first line \"# parts: ...\")", "", "program.nc in files of so many lines",
       "gcode_parts", true, "", false, false, true, is_gcode_part_list, read_parts, nullptr},
      {"an XPS trajectory (lines dt, dx, vx, dy, vy)", "", "one stretch of work", "xps_trajectory", false, "", true,
       true, false, is_xps_trajectory, read_xps, nullptr},
      {"a PMAC program in PVT mode", "", "one stretch of work", "pmac_program", false, "", true, true, false,
       is_pmac_program, read_pmac, nullptr},
  };
  return kFormats;
}

const ProgramFormat* program_format_of(std::string_view text) {
  text = without_byte_order_mark(text);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return nullptr;
  for (const ProgramFormat& format : program_formats()) {
    if (format.recognise(text.substr(begin))) return &format;
  }
  return nullptr;
}

std::string export_words() {
  std::string words;
  for (const ProgramFormat& format : program_formats()) {
    if (!format.word.empty()) words += (words.empty() ? "" : ", ") + format.word;
  }
  return words;
}

std::vector<std::string> parse_exports(std::string_view text) {
  std::vector<std::string> wanted, exports;
  if (trim(text) != "none") {
    for (const std::string_view part : split(text, ',')) wanted.emplace_back(trim(part));
  }
  for (const ProgramFormat& format : program_formats()) {
    if (!format.word.empty() && is_among(format.word, wanted)) exports.push_back(format.word);
  }
  for (const std::string& word : wanted) {
    if (is_among(word, exports)) continue;
    throw InputError(fmt::format("'{}': '{}' is no format; accepted: {}, several separated by commas, or none", text,
                                 word, export_words()));
  }
  return exports;
}

std::string exports_text(const std::vector<std::string>& exports) { return fmt::format("{}", fmt::join(exports, ",")); }

std::string export_that_needs_motion(const std::vector<std::string>& exports) {
  for (const ProgramFormat& format : program_formats()) {
    if (format.needs_motion && is_among(format.word, exports)) return format.word;
  }
  return "";
}

std::string export_without_frame(const std::vector<std::string>& exports) {
  for (const ProgramFormat& format : program_formats()) {
    if (format.needs_motion && !format.in_frame && is_among(format.word, exports)) return format.word;
  }
  return "";
}

std::string export_of_end_feeds(const std::vector<std::string>& exports) {
  for (const SpeedDialect dialect : {SpeedDialect::G293, SpeedDialect::Flin}) {
    if (is_among(to_string(dialect), exports)) return std::string(to_string(dialect));
  }
  return "";
}

bool has_export_over_path(const std::vector<std::string>& exports) {
  return is_among(to_string(SpeedDialect::Flin), exports);
}

std::vector<WrittenProgram> written_programs(const ProgramToWrite& program, const ProgramWriting& writing,
                                             const std::vector<std::string>& exports, int threads,
                                             const Progress& progress) {
  std::vector<const ProgramFormat*> formats;
  for (const ProgramFormat& format : program_formats()) {
    if (is_written(format, exports, program.speeds_alone)) formats.push_back(&format);
  }
  std::vector<std::vector<WrittenProgram>> written(formats.size());
  run_side_by_side(threads, progress, formats.size(), [&](std::size_t k, const Progress& shared) {
    shared.step("write: " + formats[k]->file);
    written[k] = formats[k]->write(program, writing, shared);
  });
  std::vector<WrittenProgram> programs;
  for (std::size_t k = 0; k < formats.size(); ++k) {
    for (WrittenProgram& file : written[k]) {
      if (file.word.empty()) file.word = formats[k]->word;
      programs.push_back(std::move(file));
    }
  }
  return programs;
}

}  // namespace dwell

#include "runs/programs/program_formats.h"

#include "core/base/side_by_side.h"
#include "core/base/text_lines.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"

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

std::string write_table(const FeedTable& table, const ProgramWriting&, const Progress& progress) {
  return feed_table_text(table, progress);
}

/// Whether a text begins with a comment, a % or a word: a letter and a number.
bool is_gcode(std::string_view text) {
  if (text.empty()) return false;
  if (std::string_view("%(;/").find(text.front()) != std::string_view::npos) return true;
  const std::size_t number = text.find_first_not_of(" \t", 1);
  const bool letter = (text.front() >= 'A' && text.front() <= 'Z') || (text.front() >= 'a' && text.front() <= 'z');
  return letter && number != std::string_view::npos &&
         std::string_view("0123456789.+-").find(text[number]) != std::string_view::npos;
}

std::string write_gcode(const FeedTable& table, const ProgramWriting& writing, const Progress& progress) {
  GcodeOptions options;
  options.dialect = writing.dialect;
  options.lift_height_mm = writing.lift_height_mm;
  options.max_feed_mm_per_min = table.max_feed_mm_per_min;
  options.header = writing.header;
  return gcode_text(program_of(table), options, progress);
}

}  // namespace

const std::vector<ProgramFormat>& program_formats() {
  static const std::vector<ProgramFormat> kFormats{
      {"a feed table (first line \"# dwell ...\")", "feed.csv", "the dwell points in order, each with dwell and feed",
       "feed_table", false, is_feed_table, read_table, write_table},
      {"G-code (comments and words such as G1 X1.5)", "program.nc", "the same as G-code", "gcode", true, is_gcode,
       read_gcode, write_gcode},
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

std::vector<WrittenProgram> written_programs(const FeedTable& table, const ProgramWriting& writing, int threads,
                                             const Progress& progress) {
  const std::vector<ProgramFormat>& formats = program_formats();
  std::vector<WrittenProgram> programs(formats.size());
  run_side_by_side(threads, progress, formats.size(), [&](std::size_t k, const Progress& shared) {
    shared.step("write: " + formats[k].file);
    programs[k] = {formats[k].file, formats[k].write(table, writing, shared)};
  });
  return programs;
}

}  // namespace dwell

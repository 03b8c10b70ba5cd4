#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "runs/logs/log_columns.h"

namespace dwell {

/// The rows of a log as text, not yet read. Views are of the text, which must outlive it.
struct LogText {
  struct Line {
    long number;
    std::string_view text;
  };
  std::vector<std::string> names;  // of the columns, with their units where a line below gives these; or none
  std::size_t columns = 0;
  char separator = ',';  // ' ': any blanks
  std::vector<Line> rows;
  std::vector<Line> unread;  // comments, and what stands before the names
  std::vector<std::string> notes;
};

/// Takes a log apart. The separator is the first of ';', tab, ',' that the first row has, or else blanks. Rows begin
/// with the first line that holds two numbers; the last line before it with as many words names the columns (in a
/// comment or not), or their units below the names. A last line that was cut off is left out, which a note says. Throws
/// InputError naming the line that has another number of columns; Interrupted. Cost O(bytes).
LogText read_log_text(std::string_view text, const std::string& name, const Progress& progress = {});

/// A field of a row, without blanks and quotes around it.
std::string_view field_of(const LogText& log, std::size_t row, std::size_t column);

/// Refuses a line that was not read and that says another unit than the columns are taken in. Throws InputError.
void check_unread_lines(const LogText& log, const LogColumns& columns, const std::string& name);

}  // namespace dwell

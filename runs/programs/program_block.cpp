#include "runs/programs/program_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/whole_file.h"
#include "runs/programs/gcode_reader.h"

namespace dwell {
namespace {

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_numbered(std::string_view text) { return text.size() > 1 && (text[0] == 'N' || text[0] == 'n'); }

/// The lines of a text that begin with this block number, and how many there are in all.
struct NumberedLines {
  std::vector<std::size_t> found;
  std::size_t lines = 0;
};

NumberedLines lines_numbered(std::string_view text, std::optional<double> number) {
  NumberedLines result;
  for (TextLines lines(text); lines.next();) {
    result.lines = static_cast<std::size_t>(lines.number());
    std::string_view line = trim(lines.line());
    if (!number || !is_numbered(line)) continue;
    line.remove_prefix(1);
    const std::size_t end = std::min(line.find_first_not_of("0123456789"), line.size());
    if (parse_number(std::string(line.substr(0, end))) == number) result.found.push_back(result.lines);
  }
  return result;
}

[[noreturn]] void refuse_block(const std::filesystem::path& file, const std::string& block, const std::string& why) {
  throw InputError("resume", block, why, fmt::format("`resume` = {}: {}: {}", block, file.string(), why));
}

}  // namespace

bool is_program_block(const std::string& text) {
  return is_digits(text) || (is_numbered(text) && is_digits(std::string_view(text).substr(1)));
}

ProgramBlock find_program_block(const std::filesystem::path& file, const std::string& block,
                                const GcodeReading& reading, const Progress& progress) {
  const std::string text = read_whole_file(file);
  GcodeSteps read = read_gcode_steps(text, file.string(), reading, progress);
  const auto number = parse_number(is_numbered(block) ? block.substr(1) : block);
  const NumberedLines numbered = lines_numbered(text, is_numbered(block) ? number : std::nullopt);
  ProgramBlock found{std::move(read.program), 0, numbered.lines, 0};
  if (is_numbered(block)) {
    if (numbered.found.empty()) refuse_block(file, block, "no line has this number; required one that stands in it");
    if (numbered.found.size() > 1) {
      refuse_block(file, block,
                   fmt::format("lines {} and {} both have this number; required the line itself", numbered.found[0],
                               numbered.found[1]));
    }
    found.line = numbered.found[0];
  } else {
    if (!number || !(*number >= 1.0 && *number <= static_cast<double>(numbered.lines)))
      refuse_block(file, block, fmt::format("outside of the program; required a line from 1 to {}", numbered.lines));
    found.line = static_cast<std::size_t>(*number);
  }
  const auto& steps = found.program.steps;
  std::size_t first = 0, last = steps.size();
  while (first < steps.size() && !steps[first].removes) ++first;
  while (last > first && !steps[last - 1].removes) --last;
  if (first == last) refuse_block(file, block, "the program removes nothing");
  if (found.line < read.lines[first]) {
    refuse_block(file, block,
                 fmt::format("lies before the work, which begins in line {}: nothing was removed yet, and "
                             "the program can be run anew from its beginning",
                             read.lines[first]));
  }
  if (found.line > read.lines[last - 1]) {
    refuse_block(
        file, block,
        fmt::format("lies behind the last line of the work, {}: nothing is left to be done", read.lines[last - 1]));
  }
  const auto at = std::lower_bound(read.lines.begin(), read.lines.end(), found.line);
  found.step = static_cast<std::size_t>(at - read.lines.begin());
  return found;
}

}  // namespace dwell

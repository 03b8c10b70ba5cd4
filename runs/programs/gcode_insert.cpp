#include "runs/programs/gcode_insert.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/text_lines.h"
#include "core/base/whole_file.h"
#include "runs/programs/gcode_codes.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/gcode_words.h"
#include "runs/programs/program_comments.h"

namespace dwell {
namespace {

constexpr const char* kTrial = "probe";  // the name of the program that is tried
constexpr double kWait = 0.125;          // [s] of a halt at its end, by which it shows that it comes so far

bool ends_program(std::string_view line, const GcodePlace& where) {
  if (is_tape_mark(line)) return true;
  GcodeLine parts;
  split_gcode_line(line, where, parts);
  return std::any_of(parts.words.begin(), parts.words.end(), [](const GcodeWord& word) {
    const GcodeCode* code = gcode_code(word.letter, word.value);
    return code != nullptr && code->effect == GcodeEffect::End;
  });
}

void check_user_line(std::string_view line, const GcodePlace& where) {
  if (line.size() > kLongestLine) {
    throw InputError(fmt::format("{}: {} characters, more than controllers take; required at most {}", where.text(),
                                 line.size(), kLongestLine));
  }
  const auto odd = std::find_if(line.begin(), line.end(), [](char c) { return !is_printable_ascii({&c, 1}); });
  if (odd != line.end()) {
    throw InputError(fmt::format("{}: \"{}\" holds the byte {:02X}h; required printable ASCII, which controllers take",
                                 where.text(), comment_text(line), static_cast<unsigned char>(*odd)));
  }
  if (ends_program(line, where)) {
    throw InputError(
        fmt::format("{}: \"{}\" ends the program, whose own end follows (M2); required without M2, M30 "
                    "and %",
                    where.text(), line));
  }
}

/// Two moves about a corner, a user's lines, and a halt to see that the program comes so far with the tool lifted.
std::string probe_text(const GcodeInsert& before, const GcodeInsert& after, const GcodeOptions& options) {
  Program program;
  const double seconds = 100.0 / options.max_feed_mm_per_min * 60.0;
  program.steps = {{{0, 0}, {1, 0}, seconds, true}, {{1, 0}, {1, 1}, seconds, true}};
  GcodeOptions all = options;
  all.style.before = before.lines;
  all.style.after = after.lines;
  all.style.after.push_back(fmt::format("G4 P{}", kWait));
  return gcode_text(program, all);
}

/// A message of the reader about the probe, as one about the user's file. The probe's own comments come before the
/// first lines; behind the others are its halt and its end.
std::string about_user_line(std::string_view message, std::string_view text, const GcodeInsert& before,
                            const GcodeInsert& after) {
  const std::string place = std::string(kTrial) + ", line ";
  std::size_t number = 0;
  const char* const end = message.data() + message.size();
  const char* from = message.data() + std::min(place.size(), message.size());
  const char* const to = std::from_chars(from, end, number).ptr;
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  constexpr std::size_t kComments = 2;  // "(dwell: ...)" before the first of the user's lines
  const std::size_t last = lines - 2, first = last - after.lines.size();  // of the lines after: first + 1 to last
  if (message.starts_with(place) && number > kComments && number <= kComments + before.lines.size()) {
    return fmt::format("{}, line {}{}", before.file, number - kComments, std::string_view(to, end));
  }
  if (message.starts_with(place) && number > first && number <= last) {
    return fmt::format("{}, line {}{}", after.file, number - first, std::string_view(to, end));
  }
  return fmt::format("{}: with its lines a program is refused: {}", after.lines.empty() ? before.file : after.file,
                     message);
}

/// What of a program removes, and how its corners are taken there.
struct AtWork {
  std::vector<ProgramStep> steps;
  std::vector<std::optional<PathMode>> modes;
};

AtWork at_work_in(const Program& program) {
  AtWork work;
  std::optional<PathMode> mode;
  std::size_t next = 0;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    for (; next < program.path_modes.size() && program.path_modes[next].first_step <= i; ++next)
      mode = program.path_modes[next].mode;
    if (!program.steps[i].removes) continue;
    work.steps.push_back(program.steps[i]);
    work.modes.push_back(mode);
  }
  return work;
}

bool are_same_steps(const std::vector<ProgramStep>& a, const std::vector<ProgramStep>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ProgramStep& x, const ProgramStep& y) {
    return x.start == y.start && x.finish == y.finish && x.seconds == y.seconds;
  });
}

Program read_probe(const GcodeInsert& before, const GcodeInsert& after, const GcodeOptions& options) {
  const std::string text = probe_text(before, after, options);
  try {
    GcodeReading reading;
    if (options.machine) reading.letters = options.machine->letters;
    return read_gcode(text, kTrial, reading);
  } catch (const InputError& error) {
    throw InputError(about_user_line(error.what(), text, before, after));
  }
}

void check_probe(const GcodeInsert& before, const GcodeInsert& after, const GcodeOptions& options,
                 bool keep_path_mode) {
  const std::string& file = after.lines.empty() ? before.file : after.file;
  const Program plain = read_probe({}, {}, options), probe = read_probe(before, after, options);
  const AtWork expected = at_work_in(plain), found = at_work_in(probe);
  const ProgramStep& last = probe.steps.back();
  if (last.removes) {
    throw InputError(fmt::format("{}: leaves the tool at work (Z = 0); required lifted at the end", file));
  }
  if (!are_same_steps(found.steps, expected.steps) || last.seconds != kWait) {
    throw InputError(
        fmt::format("{}: with its lines a program would remove otherwise than without; accepted: what moves the tool "
                    "only where it is lifted, and no modes of units, coordinates or feeds that last",
                    file));
  }
  if (keep_path_mode && found.modes != expected.modes) {
    throw InputError(
        fmt::format("{}: sets how the machine takes corners (G61, G61.1, G64), otherwise than the plan; required "
                    "without, and --path-mode for it",
                    file));
  }
}

}  // namespace

GcodeInsert read_gcode_insert(const std::filesystem::path& file) {
  GcodeInsert lines{file.string(), {}};
  const std::string text = read_whole_file(file);
  for (TextLines line(text); line.next();) {
    check_user_line(line.line(), {lines.file, static_cast<std::size_t>(line.number())});
    lines.lines.emplace_back(line.line());
  }
  return lines;
}

void check_gcode_inserts(const GcodeInsert& before, const GcodeInsert& after, const GcodeOptions& options,
                         bool keep_path_mode) {
  if (!before.lines.empty()) check_probe(before, {}, options, keep_path_mode);
  if (!after.lines.empty()) check_probe(before, after, options, keep_path_mode);
}

}  // namespace dwell

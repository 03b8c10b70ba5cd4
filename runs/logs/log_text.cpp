#include "runs/logs/log_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/map/unit_mention.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

char separator_of(std::string_view line) {
  for (const char mark : {';', '\t', ','}) {
    if (line.find(mark) != std::string_view::npos) return mark;
  }
  return ' ';
}

std::string_view bare(std::string_view field) {
  field = trim(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = trim(field.substr(1, field.size() - 2));
  return field;
}

/// Calls take(k, field) with every field of a line.
template <class Take>
void each_part(std::string_view line, char separator, const Take& take) {
  std::size_t k = 0;
  if (separator != ' ') {
    while (true) {
      const std::size_t end = line.find(separator);
      take(k++, bare(line.substr(0, end)));
      if (end == std::string_view::npos) return;
      line.remove_prefix(end + 1);
    }
  }
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.size(), line.find_first_of(" \t"));
    take(k++, bare(line.substr(0, end)));
    line.remove_prefix(end);
  }
}

std::vector<std::string> parts_of_line(std::string_view line, char separator) {
  std::vector<std::string> parts;
  each_part(line, separator, [&parts](std::size_t, std::string_view part) { parts.emplace_back(part); });
  return parts;
}

std::size_t count_parts(std::string_view line, char separator) {
  std::size_t count = 0;
  each_part(line, separator, [&count](std::size_t, std::string_view) { ++count; });
  return count;
}

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%'); }

bool begins_rows(std::string_view line) {
  std::size_t numbers = 0;
  each_part(line, separator_of(line), [&numbers](std::size_t, std::string_view part) {
    numbers += static_cast<std::size_t>(parse_number(part).has_value());
  });
  return numbers >= 2;
}

/// The words of a line that may name columns, as many as there are; nothing if it may not.
std::optional<std::vector<std::string>> naming_words(const LogText::Line& line, const LogText& log) {
  std::string_view text = line.text;
  if (is_comment(text)) text = trim(text.substr(1));
  std::vector<std::string> words = parts_of_line(text, log.separator);
  const bool names = words.size() == log.columns && std::none_of(words.begin(), words.end(), [](const auto& word) {
                       return parse_number(word).has_value();
                     });
  return names ? std::optional(std::move(words)) : std::nullopt;
}

bool are_units(const std::vector<std::string>& words) {
  return std::count_if(words.begin(), words.end(), [](const auto& word) { return is_log_unit(word); }) >= 2;
}

/// Takes the lines that name the columns, and their units, out of those that are not read.
void take_names(LogText& log) {
  const auto last = [&log]() -> std::optional<std::size_t> {
    for (std::size_t i = log.unread.size(); i-- > 0;) {
      if (log.unread[i].number < log.rows.front().number && naming_words(log.unread[i], log)) return i;
    }
    return std::nullopt;
  };
  const auto take = [&log](std::size_t i) {
    std::vector<std::string> words = *naming_words(log.unread[i], log);
    log.unread.erase(log.unread.begin() + static_cast<std::ptrdiff_t>(i));
    return words;
  };
  const auto at = last();
  if (!at) return;
  log.names = take(*at);
  const auto above = last();
  if (!are_units(log.names) || !above || *above + 1 != *at) return;
  const std::vector<std::string> units = std::exchange(log.names, take(*above));
  for (std::size_t k = 0; k < units.size(); ++k) {
    if (!units[k].empty())
      log.names[k] += units[k].starts_with('[') || units[k].starts_with('(') ? units[k] : "[" + units[k] + "]";
  }
}

}  // namespace

LogText read_log_text(std::string_view text, const std::string& name, const Progress& progress) {
  LogText log;
  const bool ended = text.ends_with('\n') || text.ends_with('\r');
  Poll poll(progress, 8192);
  std::optional<LogText::Line> short_line;
  for (TextLines lines(text); lines.next();) {
    poll.step();
    const LogText::Line line{lines.number(), trim(lines.line())};
    if (line.text.empty()) continue;
    const auto refuse = [&name, &log](const LogText::Line& at) {
      throw InputError(fmt::format("{}: line {}: {}; the first row has {}", name, at.number,
                                   counted(count_parts(at.text, log.separator), "column"), log.columns));
    };
    if (short_line) refuse(*short_line);
    if (is_comment(line.text) || (log.rows.empty() && !begins_rows(line.text))) {
      log.unread.push_back(line);
      continue;
    }
    // Tabs at the end of a row are columns without a value.
    const std::string_view row = separator_of(lines.line()) == '\t' ? lines.line() : line.text;
    if (log.rows.empty()) log.separator = separator_of(row), log.columns = count_parts(row, log.separator);
    const std::size_t parts = count_parts(row, log.separator);
    if (parts < log.columns) {
      short_line = line;
    } else if (parts > log.columns) {
      refuse(line);
    } else {
      log.rows.push_back({line.number, row});
    }
  }
  if (short_line && ended) {
    throw InputError(fmt::format("{}: line {}: {}; the first row has {}", name, short_line->number,
                                 counted(count_parts(short_line->text, log.separator), "column"), log.columns));
  }
  if (log.rows.empty()) {
    throw InputError(fmt::format("{}: no line holds two numbers; rows of time and places are required", name));
  }
  if (short_line) log.notes.push_back(fmt::format("line {} was cut off and is left out", short_line->number));
  take_names(log);
  return log;
}

std::string_view field_of(const LogText& log, std::size_t row, std::size_t column) {
  std::string_view found;
  each_part(log.rows[row].text, log.separator, [&](std::size_t k, std::string_view part) {
    if (k == column) found = part;
  });
  return found;
}

void check_unread_lines(const LogText& log, const LogColumns& columns, const std::string& name) {
  const bool user_says = columns.x.from_user && columns.y.from_user && (!columns.time || columns.time->from_user);
  if (user_says) return;
  for (const LogText::Line& line : log.unread) {
    const auto unit = find_other_unit(line.text);
    if (!unit) continue;
    const auto nm = known_length_unit(*unit);
    const auto is = [&nm](const LogColumn& column) {
      return nm && !column.assumed && *nm == column.factor * units::kNmPerMm;
    };
    if (is(columns.x) && is(columns.y)) continue;
    throw InputError(
        fmt::format("{}: line {}: {} says the unit {}, but time and places are taken in other ones; say them in the "
                    "names of the columns, or by `log columns` as NAME:ms,NAME:um,NAME:um",
                    name, line.number, in_quotes(line.text), in_quotes(*unit)));
  }
}

}  // namespace dwell

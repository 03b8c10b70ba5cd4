#include "runs/programs/program_reader.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/gcode_reader.h"

namespace dwell {

Program read_program(const std::filesystem::path& file, std::optional<GcodeDialect> dialect) {
  constexpr std::string_view kAccepted =
      "accepted: a feed table (first line \"# dwell ...\") or G-code (comments and words such as G1 X1.5)";
  const std::string text = read_whole_file(file);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) throw InputError(fmt::format("{}: is empty; {}", file.string(), kAccepted));
  const std::string_view content = std::string_view(text).substr(begin);
  if (content.starts_with("# dwell") || content.starts_with("sequence,")) {
    if (dialect) {
      throw InputError(fmt::format("{}: is a feed table, for which a G-code dialect ({}) has no meaning", file.string(),
                                   to_string(*dialect)));
    }
    Program program = program_of(read_feed_table(file));
    program.file = file.string();
    return program;
  }
  if (std::string_view("%(;GgMmNnFfSsXxYyZz").find(content.front()) == std::string_view::npos) {
    throw InputError(fmt::format("{}: begins like no machine program; {}", file.string(), kAccepted));
  }
  return read_gcode(text, file.string(), dialect);
}

}  // namespace dwell

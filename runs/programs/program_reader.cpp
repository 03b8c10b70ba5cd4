#include "runs/programs/program_reader.h"

#include <fmt/format.h>

#include <string>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "runs/programs/program_formats.h"

namespace dwell {
namespace {

std::string accepted() {
  std::string names;
  for (const ProgramFormat& format : program_formats()) names += (names.empty() ? "accepted: " : " or ") + format.name;
  return names;
}

}  // namespace

Program read_program(const std::filesystem::path& file, std::optional<GcodeDialect> dialect, const Progress& progress) {
  const std::string text = read_whole_file(file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("{}: is empty; {}", file.string(), accepted()));
  }
  const ProgramFormat* format = program_format_of(text);
  if (format == nullptr) {
    throw InputError(fmt::format("{}: begins like no machine program; {}", file.string(), accepted()));
  }
  if (dialect && !format->takes_a_dialect) {
    const std::string kind = format->name.substr(0, format->name.find(" ("));
    throw InputError(fmt::format("{}: is {}, for which a G-code dialect ({}) has no meaning", file.string(), kind,
                                 to_string(*dialect)));
  }
  return format->read(text, file.string(), dialect, progress);
}

}  // namespace dwell

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

Program read_program(const std::filesystem::path& file, const GcodeReading& reading, const Progress& progress) {
  const std::string text = read_whole_file(file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("{}: is empty; {}", file.string(), accepted()));
  }
  const ProgramFormat* format = program_format_of(text);
  if (format == nullptr) {
    throw InputError(fmt::format("{}: begins like no machine program; {}", file.string(), accepted()));
  }
  if (!format->is_gcode && (reading.dialect || reading.halts)) {
    const std::string kind = format->name.substr(0, format->name.find(" ("));
    const std::string what = reading.dialect ? fmt::format("a G-code dialect ({})", to_string(*reading.dialect))
                                             : fmt::format("a unit of P in G4 ({})", to_string(*reading.halts));
    throw InputError(fmt::format("{}: is {}, for which {} has no meaning", file.string(), kind, what));
  }
  if (!format->takes_start && reading.start) {
    throw InputError(fmt::format("{}: is {}, which says where it begins; `start` has no meaning for it", file.string(),
                                 format->name.substr(0, format->name.find(" ("))));
  }
  return format->read(text, file.string(), reading, progress);
}

}  // namespace dwell

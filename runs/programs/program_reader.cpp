#include "runs/programs/program_reader.h"

#include <fmt/format.h>

#include <string>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/template_reader.h"

namespace dwell {
namespace {

std::string accepted() {
  std::string names;
  for (const ProgramFormat& format : program_formats()) names += (names.empty() ? "accepted: " : " or ") + format.name;
  return names;
}

/// What is given for another kind of programs, in words; empty if nothing is.
std::string meant_for_others(const GcodeReading& reading) {
  if (reading.dialect) return fmt::format("a G-code dialect ({})", to_string(*reading.dialect));
  if (reading.halts) return fmt::format("a unit of P in G4 ({})", to_string(*reading.halts));
  return "";
}

Program read_in_layout(const std::string& text, const std::string& file, const GcodeReading& reading,
                       const Progress& progress) {
  const std::string others = reading.start ? "`start`" : meant_for_others(reading);
  if (!others.empty()) {
    throw InputError(
        fmt::format("{}: is read by the template {}, for which {} has no meaning", file, reading.layout->file, others));
  }
  return read_by_template(text, file, *reading.layout, progress);
}

}  // namespace

Program read_program(const std::filesystem::path& file, const GcodeReading& reading, const Progress& progress) {
  const std::string text = read_whole_file(file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("{}: is empty; {}", file.string(), accepted()));
  }
  if (reading.layout) return read_in_layout(text, file.string(), reading, progress);
  const ProgramFormat* format = program_format_of(text);
  if (format == nullptr) {
    throw InputError(fmt::format("{}: begins like no machine program; {}", file.string(), accepted()));
  }
  if (const std::string others = meant_for_others(reading); !format->is_gcode && !others.empty()) {
    const std::string kind = format->name.substr(0, format->name.find(" ("));
    throw InputError(fmt::format("{}: is {}, for which {} has no meaning", file.string(), kind, others));
  }
  if (!format->takes_start && reading.start) {
    throw InputError(fmt::format("{}: is {}, which says where it begins; `start` has no meaning for it", file.string(),
                                 format->name.substr(0, format->name.find(" ("))));
  }
  return format->read(text, file.string(), reading, progress);
}

}  // namespace dwell

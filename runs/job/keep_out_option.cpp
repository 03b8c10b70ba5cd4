#include "runs/job/keep_out_option.h"

#include <fmt/format.h>

#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/whole_file.h"

namespace dwell {
namespace {

constexpr std::string_view kFile = "file:";

/// The parts that semicolons separate, without blanks around; empty ones at the end left out.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (const std::string_view part : split(text, ';')) parts.emplace_back(trim(part));
  while (!parts.empty() && parts.back().empty()) parts.pop_back();
  return parts;
}

bool is_file(const std::string& part) { return part.starts_with(kFile); }
std::string file_of(const std::string& part) { return part.substr(kFile.size()); }

Aperture parse_zone(const std::string& text) {
  Aperture area = parse_aperture(text);
  if (area.kind == Aperture::Kind::Map)
    throw InputError("'map' is the whole plane; a zone to keep out of is a part of it");
  return area;
}

}  // namespace

void check_keep_out(const std::string& text) {
  for (const std::string& part : parts_of(text)) {
    if (part == kFile) throw InputError("'file:' names no file; required file:NAME");
    if (!is_file(part)) parse_zone(part);
  }
}

std::string renamed_keep_out(const std::string& text, const std::function<std::string(const std::string&)>& name) {
  std::string renamed;
  for (const std::string& part : parts_of(text)) {
    renamed += renamed.empty() ? "" : ";";
    renamed += is_file(part) ? std::string(kFile) + name(file_of(part)) : part;
  }
  return renamed;
}

std::vector<std::string> keep_out_files(const std::string& text) {
  std::vector<std::string> files;
  for (const std::string& part : parts_of(text)) {
    if (is_file(part)) files.push_back(file_of(part));
  }
  return files;
}

std::vector<Aperture> load_keep_out(const std::string& text, std::vector<InputFile>& inputs) {
  std::vector<Aperture> zones;
  for (const std::string& part : parts_of(text)) {
    if (!is_file(part)) {
      zones.push_back(parse_zone(part));
      continue;
    }
    const std::string file = file_of(part), content = read_whole_file(file);
    inputs.push_back({"keep-out", file, sha256_of_file(file)});
    const std::size_t before = zones.size();
    for (TextLines lines(content); lines.next();) {
      const std::string line(trim(lines.line()));
      if (line.empty() || line.front() == '#') continue;
      try {
        zones.push_back(parse_zone(line));
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}, line {}: {}", file, lines.number(), error.what()));
      }
    }
    if (zones.size() == before) throw InputError(fmt::format("{}: holds no area; required one a line", file));
  }
  return zones;
}

}  // namespace dwell

#include "runs/programs/record_lines.h"

#include <fmt/format.h>

#include "core/base/utf8_text.h"

namespace dwell {
namespace {

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return with_escaped_bytes(text);
}

}  // namespace

std::vector<std::string> record_lines(const FeedTable& table) {
  std::vector<std::string> lines;
  for (const auto& [name, hash] : table.inputs)
    lines.push_back(fmt::format("input: {} sha256={}", printable(name), printable(hash)));
  for (const auto& [key, value] : table.options)
    lines.push_back(fmt::format("option: {} = {}", printable(key), printable(value)));
  return lines;
}

}  // namespace dwell

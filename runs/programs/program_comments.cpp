#include "runs/programs/program_comments.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"

namespace dwell {
namespace {

constexpr std::size_t kHashDigits = 24;   // 96 bits: no two files are mistaken for each other
constexpr std::size_t kLongestRole = 20;  // leaves room for a name
constexpr unsigned char kFirstPrinted = 0x20, kDelete = 0x7f;

bool is_printed(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= kFirstPrinted && byte < kDelete;
}

char in_brackets(char c) { return c == '(' ? '[' : c == ')' ? ']' : c; }

/// A name in at most `room` characters, its end rather than its beginning, one '?' for a letter that is not ASCII.
std::string fitted_name(std::string_view name, std::size_t room) {
  constexpr std::string_view kCut = "...";
  std::string text;
  while (!name.empty()) {
    const std::size_t size = std::max<std::size_t>(utf8_length(name), 1);
    text += size == 1 && is_printed(name[0]) ? in_brackets(name[0]) : '?';
    name.remove_prefix(size);
  }
  // So that a reader finds the hash of the line and none in the name.
  for (std::size_t at = 0; (at = text.find(" sha256=", at)) != std::string::npos;) text[at] = '?';
  if (text.size() <= room) return text;
  return std::string(kCut) + text.substr(text.size() - room + kCut.size());
}

std::string input_comment(std::string_view role_and_file, const std::string& sha256) {
  const std::size_t blank = std::min(role_and_file.find(' '), role_and_file.size());
  const std::string before = fmt::format("input: {} ", fitted_name(role_and_file.substr(0, blank), kLongestRole));
  const std::string after = " sha256=" + sha256.substr(0, kHashDigits);
  const std::string_view file = role_and_file.substr(std::min(blank + 1, role_and_file.size()));
  return before + fitted_name(file, kLongestComment - before.size() - after.size()) + after;
}

/// Where to cut a text that has room for so many characters: beside no blank, which readers and editors strip.
std::size_t place_to_cut(std::string_view text, std::size_t room) {
  for (std::size_t at = room; at > room / 2; --at) {
    if (text[at - 1] != ' ' && text[at] != ' ') return at;
  }
  return room;
}

void add_option_comments(const std::string& key, const std::string& value, std::vector<std::string>& comments) {
  const std::string text = comment_text(value);
  std::string_view rest = text, word = "option";
  do {
    const std::string before = fmt::format("{}: {} = ", word, key);
    const std::size_t room = kLongestComment - before.size();
    const std::size_t size = rest.size() <= room ? rest.size() : place_to_cut(rest, room);
    comments.push_back(before + std::string(rest.substr(0, size)));
    rest.remove_prefix(size);
    word = "option+";
  } while (!rest.empty());
}

}  // namespace

bool is_printable_ascii(std::string_view text) { return std::all_of(text.begin(), text.end(), is_printed); }

std::string comment_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > kDelete) {
      out += fmt::format("\\x{:02X}", byte);
    } else {
      out += is_printed(c) ? in_brackets(c) : '?';
    }
  }
  return out;
}

std::vector<std::string> program_comments(const FeedTable& table) {
  std::vector<std::string> comments{comment_text(fmt::format("dwell {}", table.version)).substr(0, kLongestComment)};
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const auto& [name, hash] : table.inputs) {
    comments.push_back(input_comment(name, hash));
    inputs.emplace_back(fitted_name(name.substr(0, name.find(' ')), kLongestRole), hash);
  }
  for (const auto& [key, value] : table.options) add_option_comments(key, value, comments);
  if (comments.size() > 1) {
    comments.push_back("record: " + record_hash(inputs, {table.options.begin(), table.options.end()}));
  }
  return comments;
}

std::string record_hash(const std::vector<std::pair<std::string, std::string>>& inputs,
                        const std::map<std::string, std::string>& options) {
  std::string text;
  for (const auto& [role, hash] : inputs) {
    text += fmt::format("input {} {}\n", comment_text(role), hash.substr(0, kHashDigits));
  }
  for (const auto& [key, value] : options) text += fmt::format("option {} {}\n", key, comment_text(value));
  return sha256_of(text);
}

bool is_same_hash(std::string_view a, std::string_view b) {
  const std::size_t size = std::min(a.size(), b.size());
  return a == b || (size >= kHashDigits && a.substr(0, size) == b.substr(0, size));
}

}  // namespace dwell

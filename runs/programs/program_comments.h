#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runs/programs/feed_table.h"

namespace dwell {

/// Controllers refuse programs with longer lines (LinuxCNC ends at 255 characters, others before), and what is not
/// printable ASCII.
inline constexpr std::size_t kLongestLine = 80;
/// Of a comment, without its parentheses.
inline constexpr std::size_t kLongestComment = kLongestLine - 2;

/// Whether all characters are printable ASCII.
bool is_printable_ascii(std::string_view text);

/// A text as the comment of a program holds it: parentheses become brackets, control characters '?', and what is not
/// ASCII is written as \xE9, a byte each.
std::string comment_text(std::string_view text);

/// The comments with which a program says how it was made, none longer than kLongestComment: the version; of every
/// input its role, its name as far as it fits ('?' for letters that are not ASCII) and the first digits of its SHA-256;
/// every recorded option, in several lines where it is long; and their record_hash. Whole names and hashes are in the
/// feed table and in the summary.
std::vector<std::string> program_comments(const FeedTable& table);

/// SHA-256 of what the comments say of inputs (role, SHA-256) and options, so that a line that was lost or changed
/// shows. Of each SHA-256 the digits count that the comments hold.
std::string record_hash(const std::vector<std::pair<std::string, std::string>>& inputs,
                        const std::map<std::string, std::string>& options);

/// Whether a SHA-256 and what comments hold of one are the same.
bool is_same_hash(std::string_view a, std::string_view b);

}  // namespace dwell

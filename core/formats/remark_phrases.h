#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/word_list.h"
#include "core/formats/remark_words.h"

namespace dwell {

// What stands around a word of a remark, for the rules of the last guard (core/formats/remark_guard.h).

using Remark = std::vector<RemarkWord>;

/// Whether one of the words is among those known.
template <class Words>
bool holds_any(const Remark& words, const Words& known) {
  return std::any_of(words.begin(), words.end(), [&](const RemarkWord& word) { return is_among(word.folded, known); });
}

/// "not normalised": whether the word before denies this one.
bool is_denied(const Remark& words, std::size_t at);

/// Whether a word for the values stands between the two places.
bool holds_value_word(const Remark& words, std::size_t from, std::size_t to);

/// Where the clause of the word begins.
std::size_t clause_of(const Remark& words, std::size_t at);

/// Whether the clause speaks of another quantity, and not of the values.
bool is_of_another_quantity(const Remark& words, std::size_t at);

/// Whether a number with nothing else but the word's name stands behind ':' or '=': "exposure (um): 5".
bool names_a_number(const Remark& words, std::size_t at);

/// Whether the word is the unit of the number before it.
bool follows_a_number(const Remark& words, std::size_t at);

/// Whether something before the word announces a unit: "in", a bracket, a comma, ':' or '='.
bool is_announced(const Remark& words, std::size_t at);

/// The factor of the word as a unit of length or rate, alone or behind a word for the values ("z/um", "height_nm").
/// Nothing of what is mostly another word ("in", "m", "pm", "meter") where no unit is announced.
std::optional<double> unit_of_word(const Remark& words, std::size_t at);

/// The number that the word is, with a decimal point or comma.
std::optional<double> number_of(const RemarkWord& word);

}  // namespace dwell

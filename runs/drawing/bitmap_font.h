#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dwell {

/// One character of the built-in 5 x 7 font: seven rows from the top, bit 4 = leftmost of the five columns. `drop`
/// rows lower than the others, for descenders (0 or 2).
struct Glyph {
  std::array<std::uint8_t, 7> rows{};
  int drop = 0;
};

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;
inline constexpr int kGlyphAdvance = 6;  // one empty column between characters

/// The glyph of a printable ASCII character; an empty box for anything else.
Glyph glyph_of(char character);

/// Number of characters drawn for a text: the continuation bytes of UTF-8 draw nothing.
int drawn_characters(std::string_view text);

/// True for the second and later bytes of a UTF-8 sequence.
inline bool is_continuation_byte(char character) { return (static_cast<unsigned char>(character) & 0xC0U) == 0x80U; }

}  // namespace dwell

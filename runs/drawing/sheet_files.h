#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/point.h"

namespace dwell {

/// A text as it stands on a sheet: where its baseline begins [units], how long it is, and its words.
struct WrittenText {
  Point start;
  double size = 0.0;
  double width = 0.0;
  bool bold = false;
  bool upwards = false;
  std::string words;
};

/// Pixels in memory as Cairo keeps them: 32 bits a pixel, 0xRRGGBB in the low ones, rows from the top, `stride` bytes
/// apart.
struct PixelRows {
  int width = 0;
  int height = 0;
  int stride = 0;
  const unsigned char* bytes = nullptr;
};

/// Writes the pixels as a PNG file, 8-bit RGB, for speed rather than size, without time or text. Throws
/// std::runtime_error.
std::string rgb_png(const PixelRows& pixels);

/// Makes two changes to what Cairo wrote as SVG. Cairo 1.16 draws text as outlines of its letters, which look the same
/// everywhere but cannot be searched or copied: so the words are laid over them, invisible. And Cairo counts its
/// elements through the whole life of the program: here they are numbered from 1, so that the same figure has the same
/// bytes.
std::string finish_svg(const std::string& svg, const std::vector<WrittenText>& texts);

/// The text without control characters, and with a question mark for each byte that is no UTF-8: Cairo draws nothing
/// more after a text that it cannot read, and names of files may hold anything.
std::string printable_utf8(std::string_view text);

}  // namespace dwell

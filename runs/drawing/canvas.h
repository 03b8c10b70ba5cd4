#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// An RGB picture in memory. Pixel (0, 0) is the top left one, y runs down. Whatever falls outside is not drawn.
class Canvas {
 public:
  /// Throws std::invalid_argument unless both sizes are at least 1.
  Canvas(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }
  Colour pixel(int x, int y) const;

  void set(int x, int y, Colour colour);
  void fill_rectangle(int x, int y, int width, int height, Colour colour);
  /// Outline of the given thickness, drawn just outside the rectangle.
  void frame(int x, int y, int width, int height, int thickness, Colour colour);
  /// From one pixel to another, both included, one pixel wide.
  void line(int x0, int y0, int x1, int y1, Colour colour);

  /// Text in the built-in font, each dot `scale` x `scale` pixels; (x, y) is the top left corner of its capitals.
  void text(int x, int y, std::string_view text, int scale, Colour colour);
  /// The same turned by 90 degrees, read from bottom to top: (x, y) is the bottom left corner of the turned text.
  void text_upwards(int x, int y, std::string_view text, int scale, Colour colour);

  /// Width of a text without the space behind its last character [pixels].
  static int text_width(std::string_view text, int scale);
  /// Height of its capitals; descenders reach 2 * scale lower.
  static int text_height(int scale);

  /// The picture as a PNG file, 8-bit RGB. The same pixels give the same bytes: no time, no text chunks.
  std::string png() const;

 private:
  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;  // rows from the top, 3 bytes a pixel
};

}  // namespace dwell

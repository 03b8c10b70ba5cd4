#include "runs/drawing/canvas.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "runs/drawing/bitmap_font.h"

namespace dwell {
namespace {

// Calls dot(column, row) for every set dot of a text, columns and rows counted in dots of the font.
template <class Dot>
void for_each_dot(std::string_view text, Dot dot) {
  int left = 0;
  for (const char c : text) {
    if (is_continuation_byte(c)) continue;
    const Glyph glyph = glyph_of(c);
    for (int row = 0; row < kGlyphHeight; ++row) {
      for (int col = 0; col < kGlyphWidth; ++col) {
        const unsigned bits = glyph.rows[static_cast<std::size_t>(row)];
        if ((bits >> (kGlyphWidth - 1 - col)) & 1U) dot(left + col, row + glyph.drop);
      }
    }
    left += kGlyphAdvance;
  }
}

}  // namespace

Canvas::Canvas(int width, int height, Colour background) : width_(width), height_(height) {
  if (width < 1 || height < 1) throw std::invalid_argument("a canvas needs at least 1 x 1 pixels");
  bytes_.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  fill_rectangle(0, 0, width, height, background);
}

Colour Canvas::pixel(int x, int y) const {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) throw std::out_of_range("pixel outside the canvas");
  const std::size_t i = offset(x, y);
  return {bytes_[i], bytes_[i + 1], bytes_[i + 2]};
}

void Canvas::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const std::size_t i = offset(x, y);
  bytes_[i] = colour.red;
  bytes_[i + 1] = colour.green;
  bytes_[i + 2] = colour.blue;
}

void Canvas::fill_rectangle(int x, int y, int width, int height, Colour colour) {
  const int right = std::min(x + width, width_);
  const int bottom = std::min(y + height, height_);
  for (int row = std::max(y, 0); row < bottom; ++row) {
    for (int col = std::max(x, 0); col < right; ++col) set(col, row, colour);
  }
}

void Canvas::frame(int x, int y, int width, int height, int thickness, Colour colour) {
  fill_rectangle(x - thickness, y - thickness, width + 2 * thickness, thickness, colour);
  fill_rectangle(x - thickness, y + height, width + 2 * thickness, thickness, colour);
  fill_rectangle(x - thickness, y, thickness, height, colour);
  fill_rectangle(x + width, y, thickness, height, colour);
}

void Canvas::line(int x0, int y0, int x1, int y1, Colour colour) {
  // Bresenham 1965, in the form with one error term for all octants.
  const int dx = std::abs(x1 - x0);
  const int dy = -std::abs(y1 - y0);
  const int step_x = x0 < x1 ? 1 : -1;
  const int step_y = y0 < y1 ? 1 : -1;
  int error = dx + dy;
  while (true) {
    set(x0, y0, colour);
    if (x0 == x1 && y0 == y1) return;
    const int doubled = 2 * error;
    if (doubled >= dy) {
      error += dy;
      x0 += step_x;
    }
    if (doubled <= dx) {
      error += dx;
      y0 += step_y;
    }
  }
}

void Canvas::text(int x, int y, std::string_view text, int scale, Colour colour) {
  for_each_dot(text, [&](int col, int row) { fill_rectangle(x + col * scale, y + row * scale, scale, scale, colour); });
}

void Canvas::text_upwards(int x, int y, std::string_view text, int scale, Colour colour) {
  for_each_dot(text,
               [&](int col, int row) { fill_rectangle(x + row * scale, y - (col + 1) * scale, scale, scale, colour); });
}

int Canvas::text_width(std::string_view text, int scale) {
  const int count = drawn_characters(text);
  return count == 0 ? 0 : scale * (count * kGlyphAdvance - (kGlyphAdvance - kGlyphWidth));
}

int Canvas::text_height(int scale) { return kGlyphHeight * scale; }

std::string Canvas::png() const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  std::string encoded(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = encoded.size();
  if (png_image_write_to_memory(&image, encoded.data(), &size, 0, bytes_.data(), 0, nullptr) == 0) {
    const std::string reason = image.message;
    png_image_free(&image);
    throw std::runtime_error("PNG encoding failed: " + reason);
  }
  encoded.resize(size);
  return encoded;
}

}  // namespace dwell

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/point.h"
#include "runs/drawing/colour.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A rectangle on a sheet [units].
struct SheetBox {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  Point centre() const { return {left + 0.5 * width, top + 0.5 * height}; }
};

struct TextStyle {
  enum class Anchor { Left, Middle, Right };

  double size = 13.0;  // of the font [units]
  bool bold = false;
  Anchor anchor = Anchor::Left;  // which part of the text lies at the point given
  bool upwards = false;          // turned by 90 degrees, read from bottom to top
  Colour colour = kInk;
};

struct LineStyle {
  Colour colour = kInk;
  double width = 1.0;  // [units]
  bool dashed = false;
};

/// Pixels of a field, 0xRRGGBB each, rows from the top.
struct Raster {
  int cols = 0;
  int rows = 0;
  std::vector<std::uint32_t> pixels;
};

/// The sheet on which a figure is drawn, by the library Cairo, which no other file of the project uses. A unit of
/// length is a point (1/72 inch), x runs to the right and y down from the top left corner. Text is UTF-8 in DejaVu
/// Sans. The same calls give the same bytes: neither times nor names of machines are written.
class Sheet {
 public:
  /// Throws std::invalid_argument unless both sizes are at least 1.
  Sheet(FigureFormat format, double width, double height);
  ~Sheet();
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  void fill(const SheetBox& box, Colour colour);
  /// A line of the given width just outside the box.
  void frame(const SheetBox& box, double width, Colour colour);
  void line(Point from, Point to, const LineStyle& style);
  /// The points joined in their order.
  void polyline(const std::vector<Point>& points, const LineStyle& style);
  void polygon(const std::vector<Point>& corners, Colour colour);
  void disc(Point centre, double radius, Colour colour);
  /// The point is where the baseline begins, where its middle is, or where it ends, as the anchor says.
  void text(Point at, std::string_view text, const TextStyle& style);
  /// The raster fills the box; in PNG a box of half as many units as there are pixels shows each pixel as it is.
  void image(const SheetBox& box, const Raster& raster);

  /// Until unclip() is called, nothing shows outside of the box.
  void clip(const SheetBox& box);
  void unclip();

  /// The file. Nothing can be drawn afterwards. Throws std::runtime_error if Cairo could not draw.
  std::string bytes();

  /// How long a text is [units].
  static double text_width(std::string_view text, const TextStyle& style);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Pixels of a PNG file for each unit of length.
inline constexpr int kPixelsPerUnit = 2;

/// Widest sheet that figures use [units]: 1,600 pixels of a PNG file.
inline constexpr double kWidestSheet = 800.0;

/// How far below the middle of a line of text its baseline lies [sizes of the font].
inline constexpr double kMiddleToBaseline = 0.36;

/// Breaks a text at spaces into lines no longer than `room` [units]; a longer word is broken too.
std::vector<std::string> break_into_lines(const std::string& text, const TextStyle& style, double room);

}  // namespace dwell

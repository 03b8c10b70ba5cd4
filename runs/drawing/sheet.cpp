#include "runs/drawing/sheet.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "runs/drawing/sheet_files.h"

namespace dwell {
namespace {

cairo_status_t append_to_string(void* into, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(into)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

int pixels(double units) { return static_cast<int>(std::lround(kPixelsPerUnit * units)); }

cairo_surface_t* new_surface(FigureFormat format, double width, double height, std::string* file) {
  switch (format) {
    case FigureFormat::Svg:
      return cairo_svg_surface_create_for_stream(append_to_string, file, width, height);
    case FigureFormat::Pdf: {
      cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append_to_string, file, width, height);
      // Cairo would write the time of the day; a fixed one keeps the bytes the same.
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
      return surface;
    }
    case FigureFormat::Png:
      break;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height));
}

void set_colour(cairo_t* pen, Colour colour) {
  cairo_set_source_rgb(pen, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

void set_line(cairo_t* pen, const LineStyle& style) {
  set_colour(pen, style.colour);
  cairo_set_line_width(pen, style.width);
  const double dash = 5.0;
  cairo_set_dash(pen, &dash, style.dashed ? 1 : 0, 0.0);
}

/// Without hinting a text has the same length in all formats and at all resolutions.
void set_font(cairo_t* pen, const TextStyle& style) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(pen, options);
  cairo_font_options_destroy(options);
  cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, style.size);
}

double width_with(cairo_t* pen, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(pen, text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace

struct Sheet::Parts {
  FigureFormat format;
  double width, height;
  std::string file;  // what SVG and PDF surfaces have written
  cairo_surface_t* surface = nullptr;
  cairo_t* pen = nullptr;
  std::vector<WrittenText> texts;

  Parts(FigureFormat wanted, double wide, double high) : format(wanted), width(wide), height(high) {
    surface = new_surface(format, width, height, &file);
    pen = cairo_create(surface);
    if (format == FigureFormat::Png) cairo_scale(pen, kPixelsPerUnit, kPixelsPerUnit);
    cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
  }
  ~Parts() {
    cairo_destroy(pen);
    cairo_surface_destroy(surface);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
};

Sheet::Sheet(FigureFormat format, double width, double height) {
  if (!(width >= 1.0 && height >= 1.0)) {
    throw std::invalid_argument(fmt::format("a sheet of {} x {} units; at least 1 x 1 required", width, height));
  }
  parts_ = std::make_unique<Parts>(format, std::ceil(width), std::ceil(height));
  fill({0.0, 0.0, parts_->width, parts_->height}, kPaper);
}

Sheet::~Sheet() = default;

void Sheet::fill(const SheetBox& box, Colour colour) {
  set_colour(parts_->pen, colour);
  cairo_rectangle(parts_->pen, box.left, box.top, box.width, box.height);
  cairo_fill(parts_->pen);
}

void Sheet::frame(const SheetBox& box, double width, Colour colour) {
  set_line(parts_->pen, {colour, width, false});
  cairo_rectangle(parts_->pen, box.left - 0.5 * width, box.top - 0.5 * width, box.width + width, box.height + width);
  cairo_stroke(parts_->pen);
}

void Sheet::line(Point from, Point to, const LineStyle& style) { polyline({from, to}, style); }

void Sheet::polyline(const std::vector<Point>& points, const LineStyle& style) {
  if (points.size() < 2) return;
  cairo_new_path(parts_->pen);
  for (const Point p : points) cairo_line_to(parts_->pen, p.x, p.y);
  set_line(parts_->pen, style);
  cairo_stroke(parts_->pen);
}

void Sheet::polygon(const std::vector<Point>& corners, Colour colour) {
  cairo_new_path(parts_->pen);
  for (const Point p : corners) cairo_line_to(parts_->pen, p.x, p.y);
  cairo_close_path(parts_->pen);
  set_colour(parts_->pen, colour);
  cairo_fill(parts_->pen);
}

void Sheet::disc(Point centre, double radius, Colour colour) {
  cairo_new_path(parts_->pen);
  cairo_arc(parts_->pen, centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  set_colour(parts_->pen, colour);
  cairo_fill(parts_->pen);
}

void Sheet::text(Point at, std::string_view text, const TextStyle& style) {
  const std::string clean = printable_utf8(text);
  if (clean.empty()) return;
  cairo_t* pen = parts_->pen;
  set_font(pen, style);
  const double width = width_with(pen, clean);
  const double shift = style.anchor == TextStyle::Anchor::Left     ? 0.0
                       : style.anchor == TextStyle::Anchor::Middle ? -0.5 * width
                                                                   : -width;
  const Point start = style.upwards ? Point{at.x, at.y - shift} : Point{at.x + shift, at.y};
  set_colour(pen, style.colour);
  cairo_save(pen);
  cairo_move_to(pen, start.x, start.y);
  if (style.upwards) cairo_rotate(pen, -0.5 * std::numbers::pi);
  cairo_show_text(pen, clean.c_str());
  cairo_restore(pen);
  parts_->texts.push_back({start, style.size, width, style.bold, style.upwards, clean});
}

void Sheet::image(const SheetBox& box, const Raster& raster) {
  const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, raster.cols);
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, raster.cols, raster.rows);
  if (unsigned char* rows = cairo_image_surface_get_data(surface)) {
    for (int row = 0; row < raster.rows; ++row) {
      const auto from = raster.pixels.begin() + static_cast<std::ptrdiff_t>(row) * raster.cols;
      std::copy(from, from + raster.cols,
                reinterpret_cast<std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(row) * stride));
    }
    cairo_surface_mark_dirty(surface);
  }
  cairo_t* pen = parts_->pen;
  cairo_save(pen);
  cairo_translate(pen, box.left, box.top);
  cairo_scale(pen, box.width / raster.cols, box.height / raster.rows);
  cairo_set_source_surface(pen, surface, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(pen), CAIRO_FILTER_NEAREST);
  cairo_rectangle(pen, 0.0, 0.0, raster.cols, raster.rows);
  cairo_fill(pen);
  cairo_restore(pen);
  cairo_surface_destroy(surface);
}

void Sheet::clip(const SheetBox& box) {
  cairo_save(parts_->pen);
  cairo_rectangle(parts_->pen, box.left, box.top, box.width, box.height);
  cairo_clip(parts_->pen);
}

void Sheet::unclip() { cairo_restore(parts_->pen); }

std::string Sheet::bytes() {
  Parts& p = *parts_;
  cairo_surface_flush(p.surface);
  const cairo_status_t status = cairo_status(p.pen);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(fmt::format("drawing a figure failed: {}", cairo_status_to_string(status)));
  }
  if (p.format == FigureFormat::Png) {
    return rgb_png({cairo_image_surface_get_width(p.surface), cairo_image_surface_get_height(p.surface),
                    cairo_image_surface_get_stride(p.surface), cairo_image_surface_get_data(p.surface)});
  }
  cairo_show_page(p.pen);
  cairo_surface_finish(p.surface);
  return p.format == FigureFormat::Svg ? finish_svg(p.file, p.texts) : std::move(p.file);
}

double Sheet::text_width(std::string_view text, const TextStyle& style) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* pen = cairo_create(surface);
  set_font(pen, style);
  const double width = width_with(pen, printable_utf8(text));
  cairo_destroy(pen);
  cairo_surface_destroy(surface);
  return width;
}

std::vector<std::string> break_into_lines(const std::string& text, const TextStyle& style, double room) {
  std::vector<std::string> lines;
  std::string line;
  const auto fits = [&](const std::string& candidate) { return Sheet::text_width(candidate, style) <= room; };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t space = std::min(text.find(' ', at), text.size());
    std::string word = text.substr(at, space - at);
    at = space + 1;
    std::string longer = line;
    if (!longer.empty()) longer += ' ';
    longer += word;
    if (fits(longer)) {
      line = std::move(longer);
      continue;
    }
    if (!line.empty()) lines.push_back(std::move(line));
    const auto begins_character = [&](std::size_t i) { return (static_cast<unsigned char>(word[i]) & 0xC0U) != 0x80U; };
    while (!fits(word)) {
      std::size_t end = word.size(), least = 1;
      while (least < word.size() && !begins_character(least)) ++least;
      while (end > least && (!begins_character(end) || !fits(word.substr(0, end)))) --end;
      lines.push_back(word.substr(0, end));
      word.erase(0, end);
    }
    line = std::move(word);
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace dwell

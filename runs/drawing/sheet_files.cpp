#include "runs/drawing/sheet_files.h"

#include <fmt/format.h>
#include <png.h>

#include <cctype>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>

#include "core/base/utf8_text.h"

namespace dwell {
namespace {

/// All that goes into a PNG file. On an error C code jumps out of write_rgb, so nothing in that function may need a
/// destructor: this class owns it all.
struct RgbFile {
  const PixelRows& pixels;
  std::vector<png_byte> row;
  std::string file, error;
};

void append_rgb(png_structp png, png_bytep data, png_size_t size) {
  static_cast<RgbFile*>(png_get_io_ptr(png))->file.append(reinterpret_cast<const char*>(data), size);
}

void keep_rgb_error(png_structp png, png_const_charp message) {
  static_cast<RgbFile*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void take_row(RgbFile& image, int y) {
  const unsigned char* from = image.pixels.bytes + static_cast<std::ptrdiff_t>(y) * image.pixels.stride;
  png_bytep to = image.row.data();
  for (int x = 0; x < image.pixels.width; ++x, from += 4) {
    std::uint32_t pixel;
    std::memcpy(&pixel, from, sizeof pixel);
    *to++ = static_cast<png_byte>(pixel >> 16);
    *to++ = static_cast<png_byte>(pixel >> 8);
    *to++ = static_cast<png_byte>(pixel);
  }
}

bool write_rgb(RgbFile& image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &image, keep_rgb_error, nullptr);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  constexpr int kFast = 2;
  constexpr png_uint_32 kPixelsPerMetre = 5669;  // 72 units an inch, kPixelsPerUnit pixels a unit
  png_set_write_fn(png, &image, append_rgb, nullptr);
  png_set_compression_level(png, kFast);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.pixels.width), static_cast<png_uint_32>(image.pixels.height),
               8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_pHYs(png, info, kPixelsPerMetre, kPixelsPerMetre, PNG_RESOLUTION_METER);
  png_write_info(png, info);
  for (int y = 0; y < image.pixels.height; ++y) {
    take_row(image, y);
    png_write_row(png, image.row.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

std::string escape_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string overlay(const std::vector<WrittenText>& texts) {
  std::string out = "<g font-family=\"DejaVu Sans\" fill-opacity=\"0\">\n";
  for (const WrittenText& t : texts) {
    out += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" textLength=\"{:.2f}\"{}{}>{}</text>\n",
                       t.start.x, t.start.y, t.size, t.width, t.bold ? " font-weight=\"bold\"" : "",
                       t.upwards ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", t.start.x, t.start.y) : "",
                       escape_xml(t.words));
  }
  return out + "</g>\n";
}

/// Numbers the names of elements from 1 on: "surface17" becomes "surface1" where they are defined (id="...") and where
/// they are referred to ("#surface17"). Image data holds neither: base64 has no quotation marks and no "#".
std::string renumber_elements(const std::string& svg) {
  std::map<std::string, std::string> names;
  const auto new_name = [&](const std::string& old) {
    const auto found = names.find(old);
    if (found != names.end()) return found->second;
    const std::string letters = old.substr(0, old.find_first_of("0123456789"));
    return names[old] = fmt::format("{}-{}", letters, names.size() + 1);
  };
  std::string out;
  out.reserve(svg.size());
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t id = svg.find(" id=\"", at), reference = svg.find('#', at);
    const std::size_t next = std::min(id, reference);
    if (next == std::string::npos) {
      out.append(svg, at);
      break;
    }
    const std::size_t begin = next + (next == id ? 5 : 1), end = svg.find_first_of("\")", begin);
    out.append(svg, at, begin - at);
    if (end == std::string::npos) break;
    out += new_name(svg.substr(begin, end - begin));
    at = end;
  }
  return out;
}

}  // namespace

std::string rgb_png(const PixelRows& pixels) {
  RgbFile image{pixels, std::vector<png_byte>(3 * static_cast<std::size_t>(pixels.width)), {}, {}};
  if (!write_rgb(image)) throw std::runtime_error("PNG encoding failed: " + image.error);
  return std::move(image.file);
}

std::string finish_svg(const std::string& svg, const std::vector<WrittenText>& texts) {
  std::string out = renumber_elements(svg);
  const std::size_t end = out.rfind("</svg>");
  if (end == std::string::npos) throw std::runtime_error("drawing a figure failed: the SVG has no end");
  out.insert(end, overlay(texts));
  return out;
}

std::string printable_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const bool control = length == 1 && std::iscntrl(static_cast<unsigned char>(text[0])) != 0;
    if (length == 0)
      out += '?';
    else if (control)
      out += ' ';
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace dwell

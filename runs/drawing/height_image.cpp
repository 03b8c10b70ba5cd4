#include "runs/drawing/height_image.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr double kLevels = 65535.0;  // the last level; the first is no data

/// height = offset + scale * level
struct Levels {
  double offset = 0.0;
  double scale = 1.0;

  std::uint16_t of(double height) const {
    if (std::isnan(height)) return 0;
    return static_cast<std::uint16_t>(std::clamp(std::round((height - offset) / scale), 1.0, kLevels));
  }
};

Levels levels_of(const HeightMap& map) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : map.values) {
    if (!std::isnan(v)) low = std::min(low, v), high = std::max(high, v);
  }
  const double scale = high > low ? (high - low) / (kLevels - 1.0) : 1.0;
  if (!std::isfinite(low - scale) || !std::isfinite(high) || !std::isnormal(scale)) {
    throw InputError(fmt::format(
        "height image: heights from {} to {} nm; a finite span of at least one pixel is required", low, high));
  }
  return {low - scale, scale};
}

/// Rows from the top, two bytes a pixel, the high one first.
std::vector<std::uint8_t> grey_bytes(const HeightMap& map, const Levels& levels) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * map.values.size());
  for (Index row = map.grid.rows; row-- > 0;) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const std::uint16_t level = levels.of(map.at(row, col));
      bytes.push_back(static_cast<std::uint8_t>(level >> 8));
      bytes.push_back(static_cast<std::uint8_t>(level & 0xff));
    }
  }
  return bytes;
}

struct Text {
  std::string key, value;
};

std::vector<Text> texts_of(const HeightMap& map, const Levels& levels) {
  const Grid& grid = map.grid;
  std::vector<Text> texts{{"offset_nm", fmt::format("{}", levels.offset)},
                          {"nm_per_level", fmt::format("{}", levels.scale)},
                          {"no_data_level", "0"},
                          {"pitch_mm", fmt::format("{},{}", grid.pitch_x, grid.pitch_y)},
                          {"origin_mm", fmt::format("{},{}", grid.origin.x, grid.origin.y)},
                          {"unit", "nm"}};
  for (const std::string& step : map.history) texts.push_back({"made", step});
  return texts;
}

/// Pixels per metre, or 0 if that is no number of the format.
std::uint32_t pixels_per_metre(double pitch_mm) {
  const double density = std::round(1e3 / pitch_mm);
  return density >= 1.0 && density <= PNG_UINT_31_MAX ? static_cast<std::uint32_t>(density) : 0;
}

/// All that goes into the file. On an error C code jumps out of write_png, so nothing in that function may need a
/// destructor: this class owns it all.
struct Image {
  png_uint_32 width = 0, height = 0;
  png_uint_32 density_x = 0, density_y = 0;
  std::vector<png_bytep> rows;
  std::vector<png_text> texts;
  std::string file;
  std::string error;
};

void append_bytes(png_structp png, png_bytep data, png_size_t size) {
  static_cast<Image*>(png_get_io_ptr(png))->file.append(reinterpret_cast<const char*>(data), size);
}

void no_flush(png_structp) {}

void keep_error(png_structp png, png_const_charp message) {
  static_cast<Image*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void no_warning(png_structp, png_const_charp) {}

bool write_png(Image& image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &image, keep_error, no_warning);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &image, append_bytes, no_flush);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, image.width, image.height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (image.density_x > 0 && image.density_y > 0) {
    png_set_pHYs(png, info, image.density_x, image.density_y, PNG_RESOLUTION_METER);
  }
  png_set_text(png, info, image.texts.data(), static_cast<int>(image.texts.size()));
  png_write_info(png, info);
  png_write_image(png, image.rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::string height_image_png(const HeightMap& map) {
  const Grid& grid = map.grid;
  if (std::max(grid.rows, grid.cols) > static_cast<Index>(PNG_UINT_31_MAX)) {
    throw InputError(fmt::format("height image: {} x {} pixels; at most {} a side are possible", grid.rows, grid.cols,
                                 PNG_UINT_31_MAX));
  }
  const Levels levels = levels_of(map);
  std::vector<std::uint8_t> bytes = grey_bytes(map, levels);
  std::vector<Text> texts = texts_of(map, levels);
  Image image;
  image.width = static_cast<png_uint_32>(grid.cols);
  image.height = static_cast<png_uint_32>(grid.rows);
  image.density_x = pixels_per_metre(grid.pitch_x);
  image.density_y = pixels_per_metre(grid.pitch_y);
  for (Index row = 0; row < grid.rows; ++row) image.rows.push_back(bytes.data() + 2 * row * grid.cols);
  for (Text& text : texts) {
    png_text chunk{};
    chunk.compression = text.key == "made" ? PNG_ITXT_COMPRESSION_NONE : PNG_TEXT_COMPRESSION_NONE;
    chunk.key = text.key.data();
    chunk.text = text.value.data();
    image.texts.push_back(chunk);
  }
  if (!write_png(image)) throw std::runtime_error("PNG encoding failed: " + image.error);
  return std::move(image.file);
}

}  // namespace dwell

#pragma once

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "runs/drawing/colour.h"

namespace dwell::testing {

/// The pixels of a PNG file as libpng reads them, independent of what wrote it.
struct DecodedPng {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;

  Colour at(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {bytes.at(i), bytes.at(i + 1), bytes.at(i + 2)};
  }
};

inline DecodedPng decode_png(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) throw std::runtime_error(image.message);
  image.format = PNG_FORMAT_RGB;
  DecodedPng decoded;
  decoded.width = static_cast<int>(image.width);
  decoded.height = static_cast<int>(image.height);
  decoded.bytes.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, decoded.bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error(image.message);
  }
  return decoded;
}

}  // namespace dwell::testing

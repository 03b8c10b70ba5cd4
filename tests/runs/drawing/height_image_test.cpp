#include "runs/drawing/height_image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <map>
#include <vector>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

/// The chunks of a PNG file, walked by hand: their type and data. No check sums: decoding checks those.
std::multimap<std::string, std::string> chunks_of(const std::string& file) {
  std::multimap<std::string, std::string> chunks;
  const auto number = [&](std::size_t at) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n << 8 | static_cast<unsigned char>(file.at(at + i));
    return n;
  };
  for (std::size_t at = 8; at < file.size(); at += 12 + number(at)) {
    chunks.emplace(file.substr(at + 4, 4), file.substr(at + 8, number(at)));
  }
  return chunks;
}

std::map<std::string, std::string> texts_of(const std::string& file) {
  std::map<std::string, std::string> texts;
  for (const auto& [type, data] : chunks_of(file)) {
    if (type == "tEXt") texts[data.substr(0, data.find('\0'))] = data.substr(data.find('\0') + 1);
  }
  return texts;
}

/// Rows from the top, as libpng reads them.
std::vector<std::uint16_t> levels_of(const std::string& file, Index rows, Index cols) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0) << image.message;
  EXPECT_EQ(image.height, static_cast<unsigned>(rows));
  EXPECT_EQ(image.width, static_cast<unsigned>(cols));
  // A file without gAMA is taken as sRGB, which "linear" would bend: so the bytes are read as they are, from IDAT.
  png_image_free(&image);
  struct Source {
    const std::string& file;
    std::size_t at = 0;
  } source{file};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &source, [](png_structp reader, png_bytep out, png_size_t size) {
    auto* from = static_cast<Source*>(png_get_io_ptr(reader));
    from->file.copy(reinterpret_cast<char*>(out), size, from->at);
    from->at += size;
  });
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  EXPECT_EQ(png_get_bit_depth(png, info), 16);
  EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_GRAY);
  std::vector<std::uint16_t> levels;
  for (Index row = 0; row < rows; ++row) {
    const png_bytep bytes = png_get_rows(png, info)[row];
    for (Index col = 0; col < cols; ++col) {
      levels.push_back(static_cast<std::uint16_t>(bytes[2 * col] << 8 | bytes[2 * col + 1]));
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return levels;
}

TEST(HeightImage, LevelsAreHeightsWithTheLargestYOnTop) {
  HeightMap map(Grid{2, 3, 0.1, 0.25, {-1.7, 0.3}}, {-10.0, NAN, 3.25, 20.0, 0.0, 7.5});
  map.history = {"read part.dat", "caf\xc3\xa9"};
  const std::string file = height_image_png(map);
  const auto levels = levels_of(file, 2, 3);
  const auto texts = texts_of(file);
  const double offset = std::stod(texts.at("offset_nm")), scale = std::stod(texts.at("nm_per_level"));
  EXPECT_DOUBLE_EQ(scale, 30.0 / 65534.0);
  EXPECT_EQ(levels[0], 65535);  // 20 nm, at the largest y
  EXPECT_EQ(levels[3], 1);      // -10 nm
  EXPECT_EQ(levels[4], 0);      // no data
  for (Index row = 0; row < 2; ++row) {
    for (Index col = 0; col < 3; ++col) {
      const double height = map.at(row, col);
      if (std::isnan(height)) continue;
      const double read = offset + scale * levels[static_cast<std::size_t>((1 - row) * 3 + col)];
      EXPECT_LE(std::abs(read - height), 0.5000001 * scale) << row << ' ' << col;
    }
  }
  EXPECT_EQ(texts.at("no_data_level"), "0");
  EXPECT_EQ(texts.at("pitch_mm"), "0.1,0.25");
  EXPECT_EQ(texts.at("origin_mm"), "-1.7,0.3");
  EXPECT_EQ(texts.at("unit"), "nm");
  const auto chunks = chunks_of(file);
  using namespace std::string_literals;
  EXPECT_EQ(chunks.find("pHYs")->second, "\0\0\x27\x10\0\0\x0f\xa0\x01"s);  // 10000 and 4000 pixels a metre
  std::vector<std::string> made;
  for (auto [at, end] = chunks.equal_range("iTXt"); at != end; ++at) made.push_back(at->second);
  EXPECT_EQ(made, (std::vector{"made\0\0\0\0\0read part.dat"s, "made\0\0\0\0\0caf\xc3\xa9"s}));
  EXPECT_EQ(file, height_image_png(map));
}

TEST(HeightImage, OneHeightAndPitchesBeyondTheFormat) {
  const std::string file = height_image_png(HeightMap(Grid{1, 2, 1e9, 1e-9, {}}, {NAN, 5.0}));
  EXPECT_EQ(levels_of(file, 1, 2), (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(texts_of(file).at("offset_nm"), "4");
  EXPECT_EQ(texts_of(file).at("nm_per_level"), "1");
  EXPECT_EQ(chunks_of(file).count("pHYs"), 0u);
}

TEST(HeightImage, RefusesWhatHasNoLevels) {
  const auto refused = [](std::vector<double> values) {
    const HeightMap map(Grid{1, 2, 1.0, 1.0, {}}, std::move(values));
    test::expect_input_error([&] { height_image_png(map); }, {"height image", "finite"});
  };
  refused({NAN, NAN});
  refused({1.0, HUGE_VAL});
  refused({-HUGE_VAL, NAN});
  refused({-1.7e308, 1.7e308});
  refused({0.0, 1e-310});
}

}  // namespace
}  // namespace dwell

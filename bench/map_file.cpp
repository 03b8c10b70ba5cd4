#include "bench/map_file.h"

#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/base/random_numbers.h"
#include "core/base/whole_file.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"

namespace dwell::bench {
namespace {

constexpr double kHole = 0.2;

void put(std::string& bytes, std::size_t at, std::size_t count, std::uint64_t value) {
  for (std::size_t i = count; i-- > 0; value >>= 8U) bytes[at + i] = static_cast<char>(value & 0xffU);
}

std::string dat_bytes(long size) {
  constexpr std::size_t kHeader = 834;
  constexpr std::uint32_t kNoData = 2147483640;
  const auto edge = static_cast<std::size_t>(size), pixels = edge * edge;
  std::string bytes(kHeader + 6 * pixels, '\0');
  put(bytes, 0, 4, 0x881b036f);
  put(bytes, 4, 2, 1);
  put(bytes, 6, 4, kHeader);
  for (const std::size_t at : {52, 54, 68, 70}) put(bytes, at, 2, edge);
  put(bytes, 56, 2, 1);
  put(bytes, 60, 4, 2 * pixels);
  put(bytes, 72, 4, 4 * pixels);
  const auto real = [&](std::size_t at, float value) { put(bytes, at, 4, std::bit_cast<std::uint32_t>(value)); };
  real(164, 0.5F);
  real(168, 6.328e-7F);
  real(176, 1.0F);
  real(184, 1e-4F);
  put(bytes, 218, 2, 1);
  RandomNumbers random(5);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto height = static_cast<std::uint32_t>(static_cast<std::int32_t>(1e4 * random.normal()));
    put(bytes, kHeader + 2 * pixels + 4 * i, 4, random.uniform() < kHole ? kNoData : height);
  }
  return bytes;
}

std::vector<double> noise(long size, double no_data) {
  RandomNumbers random(5);
  std::vector<double> values(static_cast<std::size_t>(size * size));
  for (double& v : values) v = random.uniform() < kHole ? no_data : random.normal();
  return values;
}

std::string datx_bytes(long size) {
  constexpr double kNoData = std::numeric_limits<double>::max();
  const std::vector<double> values = noise(size, kNoData);
  Hdf5Content content;
  content.path = "Data/Surface/{1}";
  content.rows = content.cols = static_cast<std::size_t>(size);
  content.values = values;
  content.numbers = {{"No Data", {kNoData}},
                     {"Wavelength", {6.328e-7}},
                     {"Interferometric Scale Factor", {0.5}},
                     {"Obliquity Factor", {1.0}}};
  content.texts = {{"Unit", "Fringes"}};
  return hdf5_bytes(content);
}

std::string bytes_of(const std::string& format, long size) {
  if (format == "dat") return dat_bytes(size);
  if (format == "datx") return datx_bytes(size);
  if (format == "npy") return npy_bytes(HeightMap(Grid{size, size, 1.0, 1.0, {}}, noise(size, std::nan(""))));
  throw std::logic_error("no map file of format " + format);
}

}  // namespace

MapFile::MapFile(const std::string& format, long size) : file_(folder_.path() / ("map." + format)) {
  write_whole_file(file_, bytes_of(format, size));
}

void MapFile::read_map() const {
  MapReadOptions options;
  if (file_.extension() != ".dat") options.pitch = square_pitch(0.1);
  const HeightMap map = dwell::read_map(file_, options);
  benchmark::DoNotOptimize(map.values.data());
}

void MapFile::read_bytes() const {
  const std::string bytes = read_whole_file(file_);
  benchmark::DoNotOptimize(bytes.data());
}

}  // namespace dwell::bench

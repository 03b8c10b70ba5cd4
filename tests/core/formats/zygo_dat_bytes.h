#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace dwell::test {

/// A MetroPro file as its layout says, written byte by byte (big endian); nothing in it is symmetric.
struct ZygoDatFile {
  std::uint32_t magic = 0x881b036f;
  unsigned format = 1, header_size = 834;
  unsigned intensity_cols = 5, intensity_rows = 3, frames = 2;
  unsigned left = 7, top = 11;
  unsigned cols = 3, rows = 2;
  std::uint32_t intensity_bytes = 5 * 3 * 2 * 2, phase_bytes = 3 * 2 * 4;
  float scale = 0.5F, wavelength = 6.328e-7F, obliquity = 1.25F, resolution = 2e-4F;
  unsigned phase_resolution = 1, sign = 0;
  std::vector<std::int32_t> phase{100, -200, 2147483640, 32768, 2147483647, -2147483647};

  std::string bytes() const {
    std::string header(header_size, '\0');
    put32(header, 0, magic);
    put16(header, 4, format);
    put32(header, 6, header_size);
    put16(header, 52, intensity_cols);
    put16(header, 54, intensity_rows);
    put16(header, 56, frames);
    put32(header, 60, intensity_bytes);
    put16(header, 64, left);
    put16(header, 66, top);
    put16(header, 68, cols);
    put16(header, 70, rows);
    put32(header, 72, phase_bytes);
    put32(header, 164, std::bit_cast<std::uint32_t>(scale));
    put32(header, 168, std::bit_cast<std::uint32_t>(wavelength));
    put32(header, 176, std::bit_cast<std::uint32_t>(obliquity));
    put32(header, 184, std::bit_cast<std::uint32_t>(resolution));
    put16(header, 218, phase_resolution);
    put16(header, 232, sign);
    std::string all = header + std::string(intensity_bytes, '\x7f');  // would read as heights of 2139062143
    for (const std::int32_t value : phase) {
      all += std::string(4, '\0');
      put32(all, all.size() - 4, static_cast<std::uint32_t>(value));
    }
    return all;
  }

 private:
  static void put16(std::string& bytes, std::size_t at, unsigned value) {
    bytes[at] = static_cast<char>(value >> 8);
    bytes[at + 1] = static_cast<char>(value);
  }
  static void put32(std::string& bytes, std::size_t at, std::uint32_t value) {
    put16(bytes, at, value >> 16);
    put16(bytes, at + 2, value & 0xffff);
  }
};

}  // namespace dwell::test

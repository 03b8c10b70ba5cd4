#include "core/formats/zygo_dat.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/units.h"

namespace dwell {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kZygoMagic = "\x88\x1b\x03"sv;  // one more byte tells the format
constexpr std::int32_t kInvalid = 2147483640;

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

struct Variant {
  std::uint32_t magic, format, header_size;
};

constexpr std::array kVariants{Variant{0x881b036f, 1, 834}, Variant{0x881b0370, 2, 834}, Variant{0x881b0371, 3, 4096}};

/// The numbers to a fringe, by the code of the phase resolution.
constexpr std::array kResolutions{4096.0, 32768.0, 131072.0};

/// The header. A field is named by its first byte, counted from 0.
class Header {
 public:
  Header(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {
    constexpr std::size_t kBeforeSize = 10;
    require(kBeforeSize);
    const Variant found{unsigned32(0), unsigned16(4), unsigned32(6)};
    for (const Variant& v : kVariants) {
      if (found.magic == v.magic && found.format == v.format && found.header_size == v.header_size) {
        require(v.header_size);
        size_ = v.header_size;
        return;
      }
    }
    throw InputError(fmt::format(
        "{}: Zygo .dat file of magic number {:#x} (byte 0), header format {} (byte 4) and header size {} (byte 6); "
        "accepted: 0x881b036f, 1, 834 or 0x881b0370, 2, 834 or 0x881b0371, 3, 4096",
        where, found.magic, found.format, found.header_size));
  }

  std::size_t size() const { return size_; }
  std::uint32_t unsigned16(std::size_t byte) const { return big_endian(bytes_.substr(byte, 2)); }
  int signed16(std::size_t byte) const { return static_cast<std::int16_t>(unsigned16(byte)); }
  std::uint32_t unsigned32(std::size_t byte) const { return big_endian(bytes_.substr(byte, 4)); }
  double real(std::size_t byte) const { return std::bit_cast<float>(unsigned32(byte)); }

  double positive(std::size_t byte, const char* name) const {
    const double value = real(byte);
    if (std::isfinite(value) && value > 0.0) return value;
    refuse(byte, name, value, "a finite number > 0 is required");
  }

  template <class Value>
  [[noreturn]] void refuse(std::size_t byte, const char* name, Value value, std::string_view required) const {
    throw InputError(fmt::format("{}: {} = {} (byte {} of the Zygo header); {}", where_, name, value, byte, required));
  }

 private:
  void require(std::size_t size) const {
    if (bytes_.size() >= size) return;
    throw InputError(
        fmt::format("{}: truncated Zygo .dat file; {} bytes, its header needs {}", where_, bytes_.size(), size));
  }

  std::string_view bytes_;
  const std::string& where_;
  std::size_t size_ = 0;
};

/// Where the heights are in the file, and how many.
struct Block {
  std::size_t begin = 0, rows = 0, cols = 0;
};

/// Checks the sizes of both blocks against each other and the file. Sizes are of 16 bits: nothing here can overflow.
Block phase_block(const Header& header, std::size_t file_size, const std::string& where) {
  const std::uint64_t frames = std::max<std::uint64_t>(header.unsigned16(56), 1);  // 0 is also written for one
  const std::uint64_t intensity = std::uint64_t{2} * header.unsigned16(52) * header.unsigned16(54) * frames;
  const std::uint32_t intensity_bytes = header.unsigned32(60);
  if (intensity_bytes != 0 && intensity_bytes != intensity) {
    header.refuse(60, "size of the intensity block", intensity_bytes,
                  fmt::format("{} columns x {} rows x {} frames of 2 bytes need {}", header.unsigned16(52),
                              header.unsigned16(54), frames, intensity));
  }
  const Block block{header.size() + intensity_bytes, header.unsigned16(70), header.unsigned16(68)};
  if (block.rows == 0 || block.cols == 0) {
    throw InputError(
        fmt::format("{}: the Zygo file holds {} (byte 68) x {} rows (byte 70) of heights; at "
                    "least one of each is required",
                    where, counted(block.cols, "column"), block.rows));
  }
  const std::uint64_t phase = std::uint64_t{4} * block.rows * block.cols;
  if (header.unsigned32(72) != phase) {
    header.refuse(72, "size of the phase block", header.unsigned32(72),
                  fmt::format("{} columns x {} rows of 4 bytes need {}", block.cols, block.rows, phase));
  }
  if (block.begin + phase != file_size) {
    throw InputError(
        fmt::format("{}: {} Zygo .dat file; {} bytes, but header ({}), intensity ({}) and phase ({}) need {}", where,
                    file_size < block.begin + phase ? "truncated" : "overlong", file_size, header.size(),
                    intensity_bytes, phase, block.begin + phase));
  }
  return block;
}

/// Factor from a stored number to nm; what the header says of waves goes into that of the map.
double height_factor(const Header& header, MapHeader& said) {
  const std::uint32_t code = header.unsigned16(218);
  if (code >= kResolutions.size()) {
    header.refuse(218, "code of the phase resolution", code, "0, 1 and 2 (4096, 32768, 131072 to a fringe) are known");
  }
  const std::uint32_t sign = header.unsigned16(232);
  if (sign != 0) {
    header.refuse(232, "data sign", sign,
                  "only 0 (normal) is accepted: whether heights of inverted data are stored inverted is not agreed; "
                  "save the data with normal sign, or in another format");
  }
  const double scale = header.positive(164, "interferometric scale factor");
  const double obliquity = header.positive(176, "obliquity factor");
  const double wavelength = header.positive(168, "wavelength");
  said.wavelength = wavelength * units::kNmPerM;
  said.wave_scale = scale * obliquity;
  said.from_waves = true;
  said.wave_field =
      "the Zygo header (interferometric scale factor, byte 164, times obliquity factor; wavelength, byte 168)";
  return scale * obliquity * wavelength / kResolutions[code] * units::kNmPerM;
}

}  // namespace

bool is_zygo_dat(std::string_view bytes) { return bytes.starts_with(kZygoMagic); }

MapSource parse_zygo_dat(std::string_view bytes, const std::string& where, const PixelLimit& limit) {
  const Header header(bytes, where);
  const Block block = phase_block(header, bytes.size(), where);
  check_pixels(static_cast<double>(block.rows), static_cast<double>(block.cols), limit, where);
  MapSource source;
  const double factor = height_factor(header, source.header);
  const double resolution = header.real(184);
  if (!(std::isfinite(resolution) && resolution >= 0.0)) {
    header.refuse(184, "lateral resolution", resolution, "a finite number >= 0 is required");
  }
  source.rows = static_cast<Index>(block.rows);
  source.cols = static_cast<Index>(block.cols);
  source.header.unit = "nm";
  source.header.pitch_rounding = kSinglePitchRounding;
  source.pitch_hint = "; its lateral resolution (byte 184) is 0, unknown";
  source.pitch_field = fmt::format("lateral resolution = {} m (byte 184 of the Zygo header)", resolution);
  if (resolution > 0.0) source.header.pitch = Point{resolution * units::kMmPerM, resolution * units::kMmPerM};
  const double bottom = header.signed16(66) + static_cast<double>(block.rows - 1);
  source.camera_pixel = {static_cast<double>(header.signed16(64)), 0.0 - bottom};
  source.values.resize(block.rows * block.cols);
  const char* from = bytes.data() + block.begin;
  for (std::size_t row = block.rows; row-- > 0;) {
    double* to = source.values.data() + row * block.cols;
    for (std::size_t col = 0; col < block.cols; ++col, from += 4) {
      const auto stored = static_cast<std::int32_t>(big_endian({from, 4}));
      to[col] = stored >= kInvalid ? std::numeric_limits<double>::quiet_NaN() : factor * stored;
    }
  }
  return source;
}

}  // namespace dwell

#include "core/formats/fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/fits_handle.h"
#include "core/formats/isolated_reader.h"

namespace dwell {
namespace {

struct Length {
  const char* name;
  double mm;
};

constexpr std::array kLengths{Length{"m", units::kMmPerM}, Length{"mm", 1.0}, Length{"um", 1e-3},
                              Length{"micron", 1e-3}, Length{"nm", 1e-6}};

/// The keywords of the image that is open.
class Keywords {
 public:
  Keywords(fitsfile* file, const std::string& where) : file_(file), where_(where) {}

  std::optional<double> number(const std::string& name) const {
    double value = 0.0;
    int status = 0;
    fits_read_key(file_, TDOUBLE, name.c_str(), &value, nullptr, &status);
    if (absent(status)) return std::nullopt;
    if (status != 0) refuse(name, fits_message(status), "a number is required");
    if (!std::isfinite(value)) refuse(name, fmt::format("{}", value), "a finite number is required");
    return value;
  }
  std::optional<std::string> text(const std::string& name) const {
    char* value = nullptr;
    int status = 0;
    fits_read_key_longstr(file_, name.c_str(), &value, nullptr, &status);
    const std::string found = value ? value : "";
    std::free(value);
    if (absent(status)) return std::nullopt;
    if (status != 0) refuse(name, fits_message(status), "a text is required");
    return std::string(trim(found));
  }
  [[noreturn]] void refuse(const std::string& name, const std::string& value, const char* required) const {
    throw InputError(fmt::format("{}: FITS keyword {} = {}; {}", where_, name, value, required));
  }

 private:
  static bool absent(int status) {
    if (status != KEY_NO_EXIST && status != VALUE_UNDEFINED) return false;
    fits_clear_errmsg();
    return true;
  }
  fitsfile* file_;
  const std::string& where_;
};

/// One axis as the keywords describe it.
struct LinearAxis {
  double pitch = 0.0, origin = 0.0;  // [mm]
};

/// Nothing if it is not in a unit of length: the angles of the sky are no pitch.
std::optional<LinearAxis> axis(const Keywords& keywords, int number) {
  const std::string n = std::to_string(number);
  const std::string unit = keywords.text("CUNIT" + n).value_or("");
  const auto* length = std::find_if(kLengths.begin(), kLengths.end(), [&](const Length& l) { return unit == l.name; });
  if (length == kLengths.end()) return std::nullopt;
  std::string name = "CDELT" + n;
  std::optional<double> step = keywords.number(name);
  if (!step) {
    name = fmt::format("CD{}_{}", n, n);
    step = keywords.number(name);
    for (const std::string other : {"CD1_2", "CD2_1"}) {
      const double across = keywords.number(other).value_or(0.0);
      if (step && across != 0.0)
        keywords.refuse(other, fmt::format("{}", across), "0 (axes along x and y) is required");
    }
  }
  if (!step) return std::nullopt;
  if (!(*step > 0.0)) keywords.refuse(name, fmt::format("{}", *step), "a step > 0 is required");
  const double reference = keywords.number("CRPIX" + n).value_or(0.0);
  const double value = keywords.number("CRVAL" + n).value_or(0.0);
  const LinearAxis found{*step * length->mm, (value + (1.0 - reference) * *step) * length->mm};
  if (!std::isfinite(found.pitch) || !std::isfinite(found.origin)) {
    keywords.refuse(name, fmt::format("{}", *step), "a pitch and an origin that are finite in mm are required");
  }
  return found;
}

MapHeader header_of(const Keywords& keywords) {
  MapHeader header;
  const std::optional<LinearAxis> x = axis(keywords, 1), y = axis(keywords, 2);
  if (x && y) {
    header.pitch = Point{x->pitch, y->pitch};
    header.origin = Point{x->origin, y->origin};
  }
  if (const std::optional<double> pitch = keywords.number("PITCHMM")) {
    if (!(*pitch > 0.0)) keywords.refuse("PITCHMM", fmt::format("{}", *pitch), "a pitch > 0 mm is required");
    header.pitch = Point{*pitch, *pitch};
  }
  if (const auto unit = keywords.text("BUNIT"); unit && !unit->empty()) {
    header.unit = *unit == "micron" ? "um" : *unit;
  }
  for (int step = 1; const auto made = keywords.text(fmt::format("MADE{}", step)); ++step) {
    header.history.push_back(*made);
  }
  return header;
}

struct Image {
  int bitpix = 0;
  Index rows = 0, cols = 0;
};

/// The image of the unit that is open, if it is one of a map.
std::optional<Image> image(fitsfile* file) {
  constexpr int kAxes = 99;
  std::array<LONGLONG, kAxes> sizes{};
  int bitpix = 0, count = 0, type = 0, status = 0;
  if (fits_get_hdu_type(file, &type, &status) != 0 || type != IMAGE_HDU) return std::nullopt;
  fits_get_img_paramll(file, kAxes, &bitpix, &count, sizes.data(), &status);
  if (status != 0 || count < 2 || count > kAxes) return std::nullopt;
  if (sizes[0] < 1 || sizes[1] < 1) return std::nullopt;
  if (std::any_of(sizes.begin() + 2, sizes.begin() + count, [](LONGLONG size) { return size != 1; })) {
    return std::nullopt;
  }
  return Image{bitpix, static_cast<Index>(sizes[1]), static_cast<Index>(sizes[0])};
}

/// Moves to the first image of a map.
Image find_image(fitsfile* file, const std::string& where) {
  int status = 0;
  for (int unit = 1; fits_movabs_hdu(file, unit, nullptr, &status) == 0; ++unit) {
    const std::optional<Image> found = image(file);
    if (!found) continue;
    int ignored = 0;
    if (fits_is_compressed_image(file, &ignored)) {
      throw InputError(fmt::format("{}: the image in unit {} of the FITS file is tile-compressed; unpack it (funpack)",
                                   where, unit));
    }
    return *found;
  }
  throw InputError(
      fmt::format("{}: the FITS file has no image of two axes (and others of length 1), which is required{}", where,
                  status == END_OF_FILE ? "" : fmt::format(" ({})", fits_message(status))));
}

/// Throws unless the file holds the numbers of the image that is open.
void check_data(fitsfile* file, const Image& image, std::size_t size, const std::string& where) {
  LONGLONG begin = 0;
  int status = 0;
  fits_get_hduaddrll(file, nullptr, &begin, nullptr, &status);
  const auto start = static_cast<std::size_t>(std::max<LONGLONG>(begin, 0));
  const std::size_t held =
      status == 0 && start < size ? (size - start) / static_cast<std::size_t>(std::abs(image.bitpix) / 8) : 0;
  if (static_cast<std::size_t>(image.rows) > held / static_cast<std::size_t>(image.cols)) {
    throw InputError(
        fmt::format("{}: truncated FITS file; NAXIS1 = {} x NAXIS2 = {} of BITPIX = {} from byte {} on in {} bytes",
                    where, image.cols, image.rows, image.bitpix, start, size));
  }
}

MapSource read_fits(std::string_view bytes, const std::string& where) {
  // CFITSIO reads whole blocks, beyond the end of memory if the last one is not: found by fuzzing.
  constexpr std::size_t kBlock = 2880;
  std::string blocks;
  if (bytes.size() % kBlock != 0) {
    blocks = bytes;
    blocks.resize((bytes.size() / kBlock + 1) * kBlock, '\0');
  }
  void* buffer =
      blocks.empty() ? const_cast<char*>(bytes.data()) : blocks.data();  // opened for reading: not written to
  std::size_t size = blocks.empty() ? bytes.size() : blocks.size();
  FitsHandle file;
  int status = 0;
  if (fits_open_memfile(file.out(), "map.fits", READONLY, &buffer, &size, 0, nullptr, &status) != 0) {
    throw InputError(fmt::format("{}: not a readable FITS file of {} bytes: {} (truncated or corrupt header)", where,
                                 bytes.size(), fits_message(status)));
  }
  const Image found = find_image(file.get(), where);
  const auto rows = static_cast<std::size_t>(found.rows), cols = static_cast<std::size_t>(found.cols);
  check_data(file.get(), found, bytes.size(), where);
  MapSource source;
  source.header = header_of(Keywords(file.get(), where));
  source.pitch_hint = ", or the file a keyword PITCHMM";
  source.rows = found.rows;
  source.cols = found.cols;
  source.values.resize(rows * cols);
  // For integers, what stands for BLANK. Floating-point numbers are taken as they are: asked for, CFITSIO would turn
  // infinity, which a map must not have, into no data.
  int any_blank = 0;  // CFITSIO wants a place for it
  double blank = found.bitpix > 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  if (fits_read_img(file.get(), TDOUBLE, 1, static_cast<LONGLONG>(source.values.size()), &blank, source.values.data(),
                    &any_blank, &status) != 0) {
    throw InputError(fmt::format("{}: the {} x {} numbers of the FITS image cannot be read: {}", where, cols, rows,
                                 fits_message(status)));
  }
  return source;
}

}  // namespace

bool is_fits(std::string_view bytes) { return bytes.starts_with("SIMPLE  ="); }

MapSource parse_fits(std::string_view bytes, const std::string& where) {
  if (!is_fits(bytes)) throw InputError(fmt::format("{}: not a FITS file; it must begin with 'SIMPLE  ='", where));
  return read_isolated([&] { return read_fits(bytes, where); }, bytes.size(), "the FITS file", where);
}

}  // namespace dwell

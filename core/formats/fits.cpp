#include "core/formats/fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/fits_handle.h"
#include "core/formats/fits_header.h"
#include "core/formats/isolated_reader.h"
#include "core/formats/packed_values.h"
#include "core/formats/unpacked_size.h"
#include "core/formats/wavefront_words.h"

namespace dwell {
namespace {

/// An image of a map: two axes, and others of length 1.
struct Image {
  int unit = 0;      // of the file, 1 = the primary one, as CFITSIO counts
  std::string name;  // EXTNAME
  int bitpix = 0;
  Index rows = 0, cols = 0;
  bool compressed = false;

  /// Its number as users know it, from `file.fits[2]` and astropy: 0 = the primary one.
  int number() const { return unit - 1; }
  std::string shown() const {
    return fmt::format("{}{} ({} x {} pixels)", number(), name.empty() ? "" : " or " + name, cols, rows);
  }
};

std::string name_of_unit(fitsfile* file) {
  std::array<char, FLEN_VALUE> name{};
  int status = 0;
  fits_read_key(file, TSTRING, "EXTNAME", name.data(), nullptr, &status);
  fits_clear_errmsg();
  return status == 0 ? std::string(trim(name.data())) : "";
}

/// The image of the unit that is open, if it is one of a map.
std::optional<Image> image(fitsfile* file, int unit) {
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
  int ignored = 0;
  return Image{unit,
               name_of_unit(file),
               bitpix,
               static_cast<Index>(sizes[1]),
               static_cast<Index>(sizes[0]),
               fits_is_compressed_image(file, &ignored) != 0};
}

std::vector<Image> images_of(fitsfile* file, const std::string& where) {
  constexpr int kMostUnits = 10'000;
  std::vector<Image> images;
  int status = 0;
  for (int unit = 1; unit <= kMostUnits && fits_movabs_hdu(file, unit, nullptr, &status) == 0; ++unit) {
    if (auto found = image(file, unit)) images.push_back(std::move(*found));
  }
  if (images.empty()) {
    throw InputError(
        fmt::format("{}: the FITS file has no image of two axes (and others of length 1), which is required{}", where,
                    status == END_OF_FILE ? "" : fmt::format(" ({})", fits_message(status))));
  }
  return images;
}

std::string list_images(const std::vector<Image>& images) {
  constexpr std::size_t kListed = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(images.size(), kListed); ++i) list += (i == 0 ? "" : ", ") + images[i].shown();
  return list + (images.size() > kListed ? ", ..." : "");
}

/// The image of that number or name; of no name, the only one.
const Image& chosen(const std::vector<Image>& images, const std::string& name, const std::string& where) {
  if (name.empty() && images.size() == 1) return images.front();
  if (name.empty()) {
    throw InputError(
        fmt::format("{}: the FITS file holds {} images; add the number or name of one to the file's name, "
                    "as ':{}': {}",
                    where, images.size(), images.back().number(), list_images(images)));
  }
  std::vector<const Image*> found;
  for (const Image& image : images) {
    if (name == std::to_string(image.number()) || lower_case(name) == lower_case(image.name)) found.push_back(&image);
  }
  if (found.size() == 1) return *found.front();
  throw InputError(fmt::format("{}: {} images of the FITS file are called {}; it holds: {}", where, found.size(),
                               in_quotes(name), list_images(images)));
}

/// Moves to the image of a map.
Image find_image(fitsfile* file, const std::string& name, const std::string& where) {
  const std::vector<Image> images = images_of(file, where);
  const Image& found = chosen(images, name, where);
  if (found.compressed) {
    throw InputError(
        fmt::format("{}: image {} of the FITS file is tile-compressed; unpack it (funpack)", where, found.shown()));
  }
  int status = 0;
  fits_movabs_hdu(file, found.unit, nullptr, &status);
  return found;
}

/// Whether an image is called a path difference, but not the one that is read.
bool another_is_wavefront(fitsfile* file, const Image& read, const std::string& where) {
  if (names_wavefront(read.name)) return false;
  const std::vector<Image> images = images_of(file, where);
  return std::any_of(images.begin(), images.end(), [](const Image& image) { return names_wavefront(image.name); });
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

/// Turns stored values of BLANK beside floating-point numbers, where the standard has no such keyword, into no data.
/// Returns what was done, for the history.
std::string take_blank(double blank, double scale, double zero, std::vector<double>& values) {
  PackedValues packing;
  packing.no_data = {{"BLANK", blank * scale + zero}};
  return unpack_values(packing, values);
}

/// What scales the stored numbers.
double scaling(fitsfile* file, const char* name, double otherwise) {
  double value = otherwise;
  int status = 0;
  fits_read_key(file, TDOUBLE, name, &value, nullptr, &status);
  fits_clear_errmsg();
  return status == 0 ? value : otherwise;
}

/// BLANK beside floating-point numbers; markers under other names are of heights, and in the header.
void take_markers(fitsfile* file, const Image& found, const FitsHeader& header, MapSource& source) {
  if (!header.blank || found.bitpix > 0) return;
  const std::string done =
      take_blank(*header.blank, scaling(file, "BSCALE", 1.0), scaling(file, "BZERO", 0.0), source.values);
  if (!done.empty()) source.header.history.push_back("read FITS: " + done);
}

MapSource describe(const Image& found, FitsHeader& header) {
  MapSource source;
  source.header = std::move(header.said.header);
  source.pitch_field = std::move(header.said.pitch_field);
  source.unclear_origin = std::move(header.said.unclear_origin);
  source.pitch_hint = ", or the file a keyword PITCHMM";
  if (!header.said.unclear_pitch.empty()) {
    source.pitch_hint += fmt::format(" (what looks like one leaves open of what it is, or in which unit: {})",
                                     header.said.unclear_pitch);
  }
  source.rows = found.rows;
  source.cols = found.cols;
  return source;
}

MapSource read_image(fitsfile* file, const Image& found, const std::string& where) {
  FitsHeader header = read_fits_header(file, where);
  MapSource source = describe(found, header);
  source.values.resize(static_cast<std::size_t>(found.rows) * static_cast<std::size_t>(found.cols));
  // For integers, what stands for BLANK. Floating-point numbers are taken as they are: asked for, CFITSIO would turn
  // infinity, which a map must not have, into no data.
  int any_blank = 0, status = 0;  // CFITSIO wants a place for the first
  double blank = found.bitpix > 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  if (fits_read_img(file, TDOUBLE, 1, static_cast<LONGLONG>(source.values.size()), &blank, source.values.data(),
                    &any_blank, &status) != 0) {
    throw InputError(fmt::format("{}: the {} x {} numbers of the FITS image cannot be read: {}", where, found.cols,
                                 found.rows, fits_message(status)));
  }
  take_markers(file, found, header, source);
  return source;
}

MapSource read_fits(std::string_view bytes, const std::string& name, const std::string& where,
                    const PixelLimit& limit) {
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
  const Image found = find_image(file.get(), name, where);
  check_data(file.get(), found, bytes.size(), where);
  check_unpacked(static_cast<double>(found.rows), static_cast<double>(found.cols), static_cast<double>(bytes.size()),
                 limit, where);
  MapSource source = read_image(file.get(), found, where);
  source.header.other_is_wavefront = another_is_wavefront(file.get(), found, where);
  return source;
}

}  // namespace

bool is_fits(std::string_view bytes) { return bytes.starts_with("SIMPLE  ="); }

MapSource parse_fits(std::string_view bytes, const std::string& where, const PixelLimit& limit) {
  return parse_fits_at(bytes, "", where, limit);
}

MapSource parse_fits_at(std::string_view bytes, const std::string& image, const std::string& where,
                        const PixelLimit& limit) {
  if (!is_fits(bytes)) throw InputError(fmt::format("{}: not a FITS file; it must begin with 'SIMPLE  ='", where));
  return read_isolated([&] { return read_fits(bytes, image, where, limit); }, bytes.size(), "the FITS file", where,
                       limit);
}

}  // namespace dwell

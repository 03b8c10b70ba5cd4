#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "core/formats/fits.h"
#include "core/formats/fits_handle.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

void require_success(int status, const char* what) {
  if (status != 0) throw std::runtime_error(fmt::format("CFITSIO cannot {}: {}", what, fits_message(status)));
}

std::string printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

void write_header(fitsfile* file, const HeightMap& map) {
  constexpr int kDigits = -17;  // significant ones: reads back equal
  int status = 0;
  const auto text = [&](const std::string& name, const char* value, const char* comment) {
    fits_write_key_str(file, name.c_str(), value, comment, &status);
  };
  const auto number = [&](const std::string& name, double value, const char* comment) {
    fits_write_key_dbl(file, name.c_str(), value, kDigits, comment, &status);
  };
  text("BUNIT", unit_of(map.quantity).c_str(), map.quantity == MapQuantity::Rate ? "removal rates" : "heights");
  const Grid& g = map.grid;
  for (const int n : {1, 2}) {
    const std::string axis = std::to_string(n);
    text("CTYPE" + axis, "LINEAR", n == 1 ? "x" : "y");
    text("CUNIT" + axis, "mm", nullptr);
    number("CRPIX" + axis, 1.0, "the first pixel");
    number("CRVAL" + axis, n == 1 ? g.origin.x : g.origin.y, "is centred here");
    number("CDELT" + axis, n == 1 ? g.pitch_x : g.pitch_y, "pitch");
  }
  if (!map.history.empty()) fits_write_key_longwarn(file, &status);
  for (std::size_t i = 0; i < map.history.size(); ++i) {
    fits_write_key_longstr(file, fmt::format("MADE{}", i + 1).c_str(), printable(map.history[i]).c_str(), nullptr,
                           &status);
  }
  require_success(status, "write a header");
}

}  // namespace

std::string fits_bytes(const HeightMap& map) {
  constexpr std::size_t kBlock = 2880;  // the unit that FITS files grow by
  void* buffer = std::malloc(kBlock);
  std::size_t size = kBlock;
  const std::unique_ptr<void*, void (*)(void**)> freed(&buffer, [](void** held) { std::free(*held); });
  FitsHandle file;
  int status = 0;
  fits_create_memfile(file.out(), &buffer, &size, kBlock, std::realloc, &status);
  require_success(status, "make a file");
  long long axes[2] = {map.grid.cols, map.grid.rows};
  fits_create_imgll(file.get(), DOUBLE_IMG, 2, axes, &status);
  require_success(status, "make an image");
  write_header(file.get(), map);
  fits_write_img(file.get(), TDOUBLE, 1, static_cast<LONGLONG>(map.values.size()),
                 const_cast<double*>(map.values.data()), &status);
  fits_flush_file(file.get(), &status);
  LONGLONG end = 0;
  fits_get_hduaddrll(file.get(), nullptr, nullptr, &end, &status);
  require_success(status, "write an image");
  require_success(file.close(), "finish a file");
  return {static_cast<const char*>(buffer), static_cast<std::size_t>(end)};
}

}  // namespace dwell

#include "core/map_formats.h"

#include <array>

#include "core/npy.h"

namespace dwell {
namespace {

constexpr std::array kFormats{
    MapFormat{"an NPY array (.npy)", [](std::string_view bytes, std::string_view) { return is_npy(bytes); }, parse_npy},
};

}  // namespace

const MapFormat* map_format_of(std::string_view bytes, std::string_view extension) {
  for (const MapFormat& format : kFormats) {
    if (format.claims(bytes, extension)) return &format;
  }
  return nullptr;
}

std::string accepted_map_formats() {
  std::string names = "a matrix of numbers (.csv, .txt), lines x y z (.xyz)";
  for (std::size_t i = 0; i < kFormats.size(); ++i) {
    names += i + 1 == kFormats.size() ? " or " : ", ";
    names += kFormats[i].name;
  }
  return names;
}

}  // namespace dwell

#include "core/map_formats.h"

#include <array>

#include "core/codev_int.h"
#include "core/npy.h"
#include "core/sdf_text.h"

namespace dwell {
namespace {

constexpr std::array kFormats{
    MapFormat{"an NPY array (.npy)", [](std::string_view bytes, std::string_view) { return is_npy(bytes); }, parse_npy},
    MapFormat{"a surface data file as text (.sdf)",
              [](std::string_view bytes, std::string_view extension) { return is_sdf(bytes) || extension == ".sdf"; },
              parse_sdf_text},
    MapFormat{
        "a Code V interferogram (.int)",
        [](std::string_view bytes, std::string_view extension) { return is_codev_int(bytes) || extension == ".int"; },
        parse_codev_int},
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

#include "core/formats/fits.h"
#include "tests/fuzz/fuzz_reader.h"

// The library reads in a process of its own: what is tried here is that nothing comes through from there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dwell::fuzz::read(data, size,
                    [](std::string_view bytes) { dwell::fuzz::require_sound(dwell::parse_fits(bytes, "map")); });
  // The second of several images.
  return dwell::fuzz::read(
      data, size, [](std::string_view bytes) { dwell::fuzz::require_sound(dwell::parse_fits_at(bytes, "1", "map")); });
}

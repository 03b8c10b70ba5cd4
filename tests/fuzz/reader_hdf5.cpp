#include "core/formats/hdf5_map.h"
#include "tests/fuzz/fuzz_reader.h"

// The library reads in a process of its own: what is tried here is that nothing comes through from there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size,
                           [](std::string_view bytes) { dwell::fuzz::require_sound(dwell::parse_hdf5(bytes, "map")); });
}

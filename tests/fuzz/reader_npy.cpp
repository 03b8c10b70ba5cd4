#include "core/formats/npy.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size,
                           [](std::string_view bytes) { dwell::fuzz::require_sound(dwell::parse_npy(bytes, "map")); });
}

#include "core/map/aperture.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::parse_aperture(dwell::to_string(dwell::parse_aperture(std::string(bytes))));
  });
}

#include "core/formats/npy_sidecar.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    // The seeds speak of a file of this SHA-256.
    const dwell::MapHeader header =
        dwell::parse_npy_sidecar(std::string(bytes), std::string(64, 'a'), "map.npy.json").header;
    dwell::fuzz::require(!header.pitch || (header.pitch->x > 0.0 && header.pitch->y > 0.0));
  });
}

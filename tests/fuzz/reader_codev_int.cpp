#include "core/formats/codev_int.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::is_codev_int(bytes);
    dwell::fuzz::require_sound(dwell::parse_codev_int(bytes, "map"));
  });
}

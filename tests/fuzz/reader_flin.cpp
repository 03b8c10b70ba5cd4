#include "runs/programs/speed_gcode_reader.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::read_speed_gcode(bytes, "flin.mpf", dwell::SpeedDialect::Flin, {});
  });
}

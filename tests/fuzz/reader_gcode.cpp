#include "runs/programs/gcode_reader.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const dwell::GcodeReading all{dwell::GcodeDialect::G93Seconds, dwell::HaltUnit::Milliseconds};
    for (const dwell::GcodeReading& reading : {dwell::GcodeReading(), all}) {
      dwell::read_gcode(bytes, "program.nc", reading);
    }
  });
}

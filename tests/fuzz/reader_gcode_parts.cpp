#include "runs/programs/gcode_parts.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    // The file beside the list in the seeds, so that its SHA-256 is right.
    const dwell::ReadBeside beside = [](const std::string& name) -> std::string {
      if (name != "one.nc") throw dwell::InputError(name);
      return "(dwell: gcode=g94, g4=seconds)\nG21\nG90\nG17\nG94\nG0 Z10\nG0 X0 Y0.5\nG1 Z0 F600\nG1 X2 Y1 F300\nG4 "
             "P0.5\n"
             "G0 Z10\nM2\n";
    };
    const dwell::Program program = dwell::parse_gcode_part_list(bytes, "parts.csv", {}, beside);
    dwell::fuzz::require(!program.steps.empty());
  });
}

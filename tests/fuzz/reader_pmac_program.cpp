#include "runs/programs/pmac_program.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    dwell::program_of(dwell::parse_pmac_program(bytes, "program", dwell::Point{1.0, -2.0}), "program");
  });
}

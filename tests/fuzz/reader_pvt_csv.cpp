#include "runs/programs/pvt_csv.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(
      data, size, [](std::string_view bytes) { dwell::program_of(dwell::parse_pvt_csv(bytes, "pvt.csv"), "pvt.csv"); });
}

#include "runs/programs/program_template.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const dwell::ProgramTemplate layout = dwell::parse_program_template(std::string(bytes), "template.toml");
    dwell::fuzz::require(!layout.move.empty() && !layout.lift.empty() && layout.ending.size() > 1);
  });
}

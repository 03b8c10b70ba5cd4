#include "core/base/spec_text.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const dwell::SpecText spec = dwell::parse_spec_text(std::string(bytes), "option");
    for (const auto& [key, value] : spec.entries) spec.optional_number(key);
  });
}

#include "paths/path_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const dwell::ToolPath path = dwell::parse_path_text(bytes, "path.csv");
    dwell::fuzz::require(!path.points.empty() && path.points.size() == path.lifted.size());
  });
}

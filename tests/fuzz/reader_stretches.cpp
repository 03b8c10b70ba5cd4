#include "runs/programs/stretches.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    // The files beside the list in the seeds, so that their SHA-256 is right.
    const dwell::ReadBeside beside = [](const std::string& name) -> std::string {
      if (name == "one.trj") return "0.500000000, 1.000000, 0.000000, -0.500000, 0.000000\n";
      if (name == "two.pmc") return "; Isx90 = 1000\n; start: X4.000000 Y5.000000\nABS\nPVT250\nX4.5:0 Y5:0\n";
      throw dwell::InputError(name);
    };
    const auto kind = dwell::is_stretch_list(bytes, dwell::StretchKind::PmacProgram)
                          ? dwell::StretchKind::PmacProgram
                          : dwell::StretchKind::XpsTrajectory;
    dwell::program_of(dwell::parse_stretch_list(bytes, "list.csv", kind, beside), "list.csv");
  });
}

#include "runs/programs/pvt_hdf5.h"
#include "tests/fuzz/fuzz_reader.h"

// The library reads in a process of its own: what is tried here is that nothing comes through from there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(
      data, size, [](std::string_view bytes) { dwell::program_of(dwell::parse_pvt_hdf5(bytes, "pvt.h5"), "pvt.h5"); });
}

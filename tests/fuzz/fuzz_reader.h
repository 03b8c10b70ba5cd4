#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/errors.h"
#include "core/formats/map_source.h"

/// What libFuzzer calls. A target is a file reader_NAME.cpp that defines it; its first inputs are in seeds/NAME.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dwell::fuzz {

/// Runs a reader on bytes. It reads them or throws InputError; any other exception is a finding, and so is what the
/// sanitizers see.
template <class Read>
int read(const std::uint8_t* data, std::size_t size, Read reader) {
  try {
    reader(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const InputError&) {
  }
  return 0;
}

/// A finding unless it holds.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// What every reader of arrays promises.
inline void require_sound(const MapSource& source) {
  require(source.rows >= 1 && source.cols >= 1);
  require(source.values.size() == static_cast<std::size_t>(source.rows) * static_cast<std::size_t>(source.cols));
  require(!source.header.pitch || (source.header.pitch->x > 0.0 && source.header.pitch->y > 0.0));
}

}  // namespace dwell::fuzz

#pragma once

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell::cli {

/// What `read` makes of the value of an option. What it refuses is refused with the option's name before it.
template <class Read>
auto of_option(const char* option, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

}  // namespace dwell::cli

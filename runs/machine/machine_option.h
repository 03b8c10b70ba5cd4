#pragma once

#include <string>
#include <string_view>

#include "runs/machine/machine_fields.h"

namespace dwell {

/// Whether the option `machine` holds the fields of a machine, as one TOML table in braces, rather than the name of a
/// file.
bool is_inline_machine(std::string_view option);

/// The machine of the option: from its file, or from the fields that stand there. Throws InputError as
/// read_machine_file.
NamedMachine machine_of_option(const std::string& option);

}  // namespace dwell

#pragma once

#include <filesystem>
#include <string>

#include "runs/machine/machine_fields.h"

namespace dwell {

/// Reads a machine file (docs/motion.md, TOML). What it does not give has no limit. Throws InputError naming the file,
/// the line or field, the value and what is accepted: an unknown field or section, a value of another type or out of
/// range, two fields that contradict each other.
NamedMachine read_machine_file(const std::filesystem::path& file);

/// The same from the text of a file; `file` is the name for messages.
NamedMachine parse_machine(const std::string& text, const std::string& file);

/// A machine file with a comment at every field; reads back equal. Fields without limit are comments.
std::string machine_text(const NamedMachine& machine);

/// A made-up machine to begin with: no product.
NamedMachine example_machine();

}  // namespace dwell

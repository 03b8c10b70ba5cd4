#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paths/feed/machine.h"

namespace dwell {

/// A machine with the name that its file gives it.
struct NamedMachine {
  std::string name;
  Machine machine;
};

/// A field of machine files. One table of these feeds reader, writer and documents.
struct MachineField {
  std::string section;  // "" = before the first section
  std::string key;      // with its unit
  std::string about;    // one line
  double least;         // accepted: from here on, or above it if `beyond`
  bool beyond;
  double& (*value)(Machine& machine);  // in the unit of the key times `scale`
  double scale;                        // the machine's value = the file's times this
};

/// Every number of a machine file, in the order in which they are written.
const std::vector<MachineField>& machine_fields();

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

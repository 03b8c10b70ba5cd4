#pragma once

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

/// What stands for the value of a field in a file; empty where there is no limit.
std::string field_text(const MachineField& field, const Machine& machine);

}  // namespace dwell

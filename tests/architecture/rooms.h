#pragma once

#include <optional>
#include <string>

namespace dwell::architecture {

/// What is wrong with including `target` from the file `path`, both of one top folder: a room includes only rooms of
/// lower rank, and no door, which is a file directly in the top folder that stands for all its rooms together. A door
/// itself may include every room.
std::optional<std::string> room_fault(const std::string& path, const std::string& target);

/// What is wrong with including `target`, a header of other people, from the file `path`: each library is known in one
/// place or few, so that it can be exchanged there.
std::optional<std::string> third_party_fault(const std::string& path, const std::string& target);

}  // namespace dwell::architecture

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/staged_files.h"
#include "core/formats/map_fields.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// FILE.npy.json, which says of FILE.npy what the format has no place for:
///
///   {"pitch_mm": [0.1, 0.25], "origin_mm": [-1.7, 0.3], "unit": "nm", "history": ["step", ...], "sha256": "..."}
///
/// sha256 is that of FILE.npy and required; the others may be left out. Keys of other programs for pitch, origin, unit
/// and no data are read as core/formats/map_fields.h has it. While FILE.npy is being replaced the sidecar
/// also has the object "previous", of the same form, for the file before.
std::filesystem::path npy_sidecar_name(const std::filesystem::path& npy_file);

/// What the text of a sidecar, which messages call `where`, says of the NPY file of this SHA-256.
SaidOfMap parse_npy_sidecar(const std::string& text, const std::string& sha256, const std::string& where);

/// What the sidecar of `npy_file`, whose bytes are given, says; nothing where there is no sidecar. Throws InputError
/// naming the sidecar and the field: not such a JSON object, or stale: sha256 is of other bytes.
SaidOfMap read_npy_sidecar(const std::filesystem::path& npy_file, std::string_view bytes);

/// The same, added to what was read of the array.
void add_npy_sidecar(const std::filesystem::path& npy_file, std::string_view bytes, MapSource& source);

/// Stages the map's values as `npy_file` and the rest as its sidecar, in such an order of renames that whenever these
/// are interrupted the file reads with its own pitch and origin: those of the file before or of the new one.
void stage_npy_with_sidecar(const std::filesystem::path& npy_file, const HeightMap& map, StagedFiles& files);

}  // namespace dwell

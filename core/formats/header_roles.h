#pragma once

#include "core/formats/header_words.h"

namespace dwell {

/// What the name of a statement in a comment speaks of.
enum class HeaderRole {
  None,         // nothing that a map is read by
  Unit,         // the unit of the values
  LateralUnit,  // the unit of x and y
  Pitch,
  Size,    // of the whole field
  Origin,  // where the map lies
  Offset,  // the same, or of the heights: not told apart
  NoData,  // the value of pixels without data
  Scale,   // a factor or offset of the values
};

struct HeaderMeaning {
  HeaderRole role = HeaderRole::None;
  bool sure = false;  // nothing else has this name; else the line is a comment like any other unless its value fits
};

/// Corrects the axis of the key where it is part of a word ("dx", "xpitch").
HeaderMeaning meaning_of(HeaderKey& key);

}  // namespace dwell

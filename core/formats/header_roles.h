#pragma once

#include "core/formats/header_words.h"
#include "core/formats/map_terms.h"

namespace dwell {

/// What the name of a statement in a comment speaks of, and how far it can be trusted.
struct HeaderMeaning {
  MapTopic topic = MapTopic::Other;
  InText trust = InText::Never;
  bool moves = false;  // an offset: of the map, or of its heights
};

/// Looks the key up in the table of names (core/formats/map_terms.h), and knows the phrases that no table holds ("unit
/// of heights", "missing value"). Corrects the axis of the key where it is part of a word ("dx", "xpitch").
HeaderMeaning meaning_of(HeaderKey& key);

}  // namespace dwell

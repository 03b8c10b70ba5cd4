#include "core/formats/map_terms.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(MapTerms, FoldsTheLettersOfGermanAndFrench) {
  EXPECT_EQ(fold_letters("H\xc3\xb6he"), "hoehe");
  EXPECT_EQ(fold_letters("H\xd6HE"), "hoehe") << "Latin-1";
  EXPECT_EQ(fold_letters("UNIT\xc3\x89"), "unite");
  EXPECT_EQ(fold_letters("Ma\xc3\x9f"), "mass");
  EXPECT_EQ(fold_letters("\xc2\xb5m \xce\xbcm \xb5m \xc3\x85"), "\xc2\xb5m \xce\xbcm \xb5m \xc3\x85") << "units stay";
  EXPECT_EQ(fold_letters("\xe9"), "e");
  EXPECT_EQ(fold_letters("\xc3"), "a");
}

TEST(MapTerms, KnowOneConceptInThreeLanguages) {
  const auto topic = [](const char* word, bool axis = false) {
    const MapTerm* term = find_map_term(word, axis);
    return term ? term->topic : MapTopic::Other;
  };
  for (const char* word : {"pitch", "pixelabstand", "pas", "pixelsize"})
    EXPECT_EQ(topic(word), MapTopic::Pitch) << word;
  for (const char* word : {"width", "breite", "largeur"}) EXPECT_EQ(topic(word), MapTopic::Size) << word;
  for (const char* word : {"origin", "ursprung", "centre", "mitte", "corner", "extent"}) {
    EXPECT_EQ(topic(word), MapTopic::Origin) << word;
  }
  for (const char* word : {"nodata", "fehlwert", "valeurmanquante"}) EXPECT_EQ(topic(word), MapTopic::NoData) << word;
  for (const char* word : {"gain", "faktor", "conversion", "waves"})
    EXPECT_EQ(topic(word), MapTopic::ValueScale) << word;
  EXPECT_EQ(topic("orientation"), MapTopic::Orientation);
  for (const char* word : {"", "operator", "zz", "a"}) EXPECT_EQ(topic(word), MapTopic::Other) << word;
  EXPECT_EQ(topic("scale", true), MapTopic::Pitch);
  EXPECT_EQ(topic("scale"), MapTopic::ValueScale);
  EXPECT_TRUE(is_unit_name("einheiten"));
  EXPECT_TRUE(is_value_word("hoehe"));
  EXPECT_FALSE(is_value_word("wavefront"));
}

}  // namespace
}  // namespace dwell

#include "core/formats/map_terms.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/word_list.h"

namespace dwell {
namespace {

constexpr InField kClear = InField::Clear, kOpen = InField::Doubtful;
constexpr InText kSure = InText::Sure, kFits = InText::Fits, kDoubt = InText::Doubtful, kSilent = InText::Never;

/// Terms of one topic that are worth the same.
struct TermGroup {
  MapTopic topic;
  InField field;
  InText text;
  bool needs_axis;
  std::string_view words;  // parted by blanks
};

constexpr TermGroup kGroups[] = {
    {MapTopic::Pitch, kClear, kSure, false,
     "pitch pixelpitch pixelsize pixsize pxsize pixelspacing spacing pixelscale pixscale pixelscl puplscal gridspacing "
     "gridpitch gridstep lateralpitch samplinginterval samplingstep samplingpitch samplingdistance samplespacing "
     "samplepitch sampledistance pointpitch pointspacing pixelwidth pixelheight mappitch pixelstep pixeldistance "
     "physicalpixelsize lateralspacing "
     "pixelabstand pixelgroesse pixelraster punktabstand messpunktabstand rasterabstand rasterweite rastermass "
     "gitterabstand gitterweite schrittweite abtastweite abtastabstand stuetzstellenabstand pixelbreite pixelhoehe "
     "pas pasdepixel paspixel pasdegrille tailledepixel taillepixel tailledupixel echantillonnage"},
    {MapTopic::Pitch, kClear, kFits, false, "step stepsize sampling abtastung"},
    {MapTopic::Pitch, kClear, kSure, true, "delta d"},
    {MapTopic::Pitch, kClear, kDoubt, false, "delta"},
    {MapTopic::Pitch, kOpen, kSure, true, "scale del"},
    {MapTopic::Pitch, kOpen, kFits, true, "inc"},
    {MapTopic::Pitch, kOpen, kSure, false,
     "lateralresolution lateralres lateralscale lateralsampling camerares cameraresolution platescale physdims "
     "cellsize lateraleaufloesung lateralaufloesung resolutionlaterale"},
    {MapTopic::Pitch, kOpen, kFits, false, "pixel increment"},
    {MapTopic::Pitch, kOpen, kDoubt, false,
     "resolution res aufloesung pix pixsz pixelsz diffelem elementsize voxelsize interval physicalpixel samplinglength "
     "pixelsper pixelspermm ppmm dpi pltscale platescl secpix calibration lateralcalibration kalibrierung etalonnage"},
    {MapTopic::Size, kOpen, kFits, false,
     "size width height extents fov fieldofview fieldview mapsize imagesize scansize scanwidth scanheight "
     "scanrange lateralsize realsize physicalsize fieldsize fieldwidth fieldheight imagewidth imageheight dimension "
     "dimensions breite bildbreite feldbreite hoehe bildhoehe feldhoehe bildgroesse feldgroesse groesse messfeld "
     "largeur hauteur taille"},
    {MapTopic::Size, kOpen, kFits, true, "range real length laenge longueur"},
    {MapTopic::Size, kOpen, kSilent, false, "diameter diam radius real range length span pupldiam aperturesize"},
    {MapTopic::Origin, kClear, kSure, false, "origin ursprung nullpunkt origine"},
    {MapTopic::Origin, kOpen, kSure, false, "firstpixel erstespixel premierpixel"},
    {MapTopic::Origin, kOpen, kSure, true, "0"},
    {MapTopic::Origin, kOpen, kFits, true, "min start"},
    {MapTopic::Origin, kOpen, kDoubt, false,
     "xy0 centerpx centrepx originpx originpixel left bottom refpixel referencepixel refpix referencepoint refpoint "
     "zeropixel bezugspunkt pixelreference "
     "corner lowerleft lowerleftcorner upperleft upperleftcorner topleft bottomleft orig org orgsubf mapcentre "
     "mapcenter centre center centerpixel centrepixel midpoint middle translation position extent bounds bbox "
     "boundingbox limits xlim ylim lateraloffset mitte zentrum mittelpunkt bildmitte ecke eckpunkt coin milieu"},
    {MapTopic::Origin, kOpen, kDoubt, true,
     "offset off pos left right first last max end stop lowerbound shift c cen ctr ref"},
    {MapTopic::Origin, kOpen, kSilent, true, "ltv"},
    {MapTopic::NoData, kClear, kSure, false,
     "nodata nodatavalue nodataval nodatava fillvalue fillval missingvalue invalidvalue badvalue badval badpixelvalue "
     "nullvalue nullval nanvalue maskvalue maskedvalue blankvalue undefinedvalue novalue sentinel fehlwert "
     "keinedaten ungueltigerwert valeurmanquante sansdonnees pasdedonnees valeurnulle"},
    {MapTopic::NoData, kOpen, kDoubt, false,
     "fill missing invalid bad null blank undefined masked void na nan dummy ungueltig fehlend manquant invalide mask "
     "empty padding padded badpix badpixel deadpixel background outside exterior offpart offaperture rest hintergrund "
     "ausserhalb aussen fond dehors maske masque"},
    {MapTopic::ValueScale, kClear, kDoubt, false,
     "scale scalefactor addoffset zscale zfactor zscalefactor zoffset multiplier slope intercept offset zmult "
     "heightscale valuescale datascale verticalscale heightfactor valuefactor heightoffset valueoffset nmpercount "
     "nmperlevel"},
    {MapTopic::ValueScale, kOpen, kDoubt, false,
     "factor gain conversion conversionfactor conversionratio calibrationfactor sensitivity lsb waves scalingfactor "
     "scaling interferometricscalefactor wedgefactor heightgain zgain heightconversion zconversion unitfactor faktor "
     "skalenfaktor skalierung skalierungsfaktor umrechnung umrechnungsfaktor verstaerkung empfindlichkeit facteur "
     "facteurdechelle echelle conversiondeshauteurs divisor divider denominator exponent signflip flipsign negate "
     "negated nmscale umscale mult multiplyby multiplied to powerof10 poweroften "
     "powerten power10 decimalexponent zexponent unitexponent prefix siprefix unitprefix metricprefix sign signs zsign "
     "heightsign magnitude magnitud orderofmagnitude ordermagnitude groessenordnung "
     "signconvention polarity vorzeichen zdirection zdir zpositive positivedirection normalised normalized "
     "normalisation normalization normalise normalize normiert normierung normed fringe"},
    {MapTopic::Label, kOpen, kSilent, false, "longname label zlabel datalabel quantity btype"},
    {MapTopic::Orientation, kOpen, kDoubt, false,
     "orientation flip flipped mirrored rotation rotate rotated transpose transposed inverted roworder rowdirection "
     "isflipped ismirrored isrotated istransposed originupper upperorigin toporigin clock clockangle mirror firstrow "
     "topline rowsfrom ausrichtung drehung gespiegelt gedreht retourne pivote flipud fliplr flips "
     "reflected "
     "reflect reflection mirroring rotangle rotationangle rot rot90 rotation90 clocking clockingangle view viewed "
     "viewedfrom viewfrom viewpoint viewdirection seenfrom handedness handed chirality transform transformation affine "
     "affinetransform angle angledeg winkel upsidedown invertx inverty swapxy swapaxes roworigin parity ansicht"},
    {MapTopic::Orientation, kOpen, kDoubt, true, "axis dir direction sign sense down invert inverted"},
    {MapTopic::AxisOrder, kClear, kDoubt, false,
     "dims dimensionlabels dimensionnames dimensionorder dimorder axes axisorder axesorder axisnames axislabels "
     "axeslabels axesnames indexorder achsen coordorder coordinateorder firstaxis firstindex"},
    {MapTopic::AxisOrder, kOpen, kDoubt, false,
     "rows order memoryorder storageorder storage memorylayout layout majororder arrayorder arraylayout"},
};

/// The terms of all groups, sorted by word.
std::vector<MapTerm> table_of_terms() {
  std::vector<MapTerm> terms;
  for (const TermGroup& group : kGroups) {
    for (const std::string_view word : split(group.words, ' ')) {
      terms.push_back({word, group.topic, group.field, group.text, group.needs_axis});
    }
  }
  std::stable_sort(terms.begin(), terms.end(), [](const MapTerm& a, const MapTerm& b) { return a.word < b.word; });
  return terms;
}

constexpr std::array<std::string_view, 71> kValueWords{
    "height",
    "heights",
    "value",
    "values",
    "surface",
    "data",
    "rate",
    "rates",
    "removal",
    "sag",
    "opd",
    "figure",
    "error",
    "errors",
    "z",
    "deviation",
    "deviations",
    "phase",
    "topography",
    "depth",
    "form",
    "shape",
    "profile",
    "amplitude",
    "amplitudes",
    "residual",
    "residuals",
    "hoehe",
    "hoehen",
    "hoehenwert",
    "hoehenwerte",
    "wert",
    "werte",
    "daten",
    "oberflaeche",
    "abweichung",
    "abweichungen",
    "fehler",
    "tiefe",
    "amplituden",
    "hauteur",
    "hauteurs",
    "valeur",
    "valeurs",
    "donnees",
    "ecart",
    "ecarts",
    "erreur",
    "profondeur",
    "altura",
    "alturas",
    "altezza",
    "altezze",
    "superficie",
    "superficies",
    "valor",
    "valores",
    "valore",
    "valori",
    "hoogte",
    "hoogtes",
    "datos",
    "dati",
    "\xd0\xb2\xd1\x8b\xd1\x81\xd0\xbe\xd1\x82\xd0\xb0",                  // Russian: height
    "\xd0\xb2\xd1\x8b\xd1\x81\xd0\xbe\xd1\x82\xd1\x8b",                  // heights
    "\xd0\xb7\xd0\xbd\xd0\xb0\xd1\x87\xd0\xb5\xd0\xbd\xd0\xb8\xd1\x8f",  // values
    "\xe9\xab\x98\xe5\xba\xa6",                                          // Chinese: height
    "\xe9\xab\x98\xe3\x81\x95",                                          // Japanese: height
    "\xe6\x95\xb0\xe5\x80\xbc",                                          // Chinese: values
    "\xe5\x80\xa4",                                                      // Japanese: value
    "\xeb\x86\x92\xec\x9d\xb4"                                           // Korean: height
};

constexpr std::array<std::string_view, 22> kValuesBeforeUnit{"",
                                                             "b",
                                                             "val",
                                                             "h",
                                                             "map",
                                                             "vertical",
                                                             "wavefront",
                                                             "w",
                                                             "sfe",
                                                             "wfe",
                                                             "dz",
                                                             "array",
                                                             "image",
                                                             "pixelvalue",
                                                             "opdmap",
                                                             "removalrate",
                                                             "heightvalue",
                                                             "surfaceheight",
                                                             "surfaceerror",
                                                             "sm",
                                                             "zaxis",
                                                             "ordinate"};

constexpr std::array<std::string_view, 30> kLateralsBeforeUnit{
    "x",       "y",          "xy",         "lateral",     "pitch",       "pixel",    "pixelsize",  "spacing",
    "spatial", "horizontal", "coordinate", "coordinates", "grid",        "origin",   "pixelscale", "step",
    "axis",    "axes",       "position",   "pix",         "length",      "xyz",      "pixelpitch", "pixelspacing",
    "size",    "sampling",   "distance",   "koordinaten", "coordonnees", "positions"};

/// What ASCII writes for a letter of Latin-1 (its code is that of Unicode too); empty: the letter stays.
std::string_view ascii_of(unsigned char code) {
  constexpr unsigned char kSharpS = 0xdf, kFirstSmall = 0xe0, kLastCapital = 0xde, kFirstCapital = 0xc0,
                          kToSmall = 0x20;
  if (code == kSharpS) return "ss";
  if (code >= kFirstCapital && code <= kLastCapital) code = static_cast<unsigned char>(code + kToSmall);
  if (code < kFirstSmall) return "";
  constexpr std::array<std::string_view, 32> kLetters{"a",  "a", "a", "a", "ae", "",  "ae", "c", "e", "e", "e",
                                                      "e",  "i", "i", "i", "i",  "",  "n",  "o", "o", "o", "o",
                                                      "oe", "",  "",  "u", "u",  "u", "ue", "y", "",  "y"};
  return kLetters.at(code - kFirstSmall);
}

/// The small letter of a Cyrillic capital of Russian, two bytes in UTF-8; empty of anything else.
std::string small_cyrillic(unsigned char first, unsigned char second) {
  constexpr unsigned char kBlock = 0xd0, kNextBlock = 0xd1, kFirst = 0x90, kMiddle = 0xa0, kLast = 0xaf,
                          kToSmall = 0x20;
  if (first != kBlock || second < kFirst || second > kLast) return "";
  const bool next = second >= kMiddle;  // the second half of the small letters is in the next block
  return {static_cast<char>(next ? kNextBlock : kBlock),
          static_cast<char>(next ? second - kToSmall : second + kToSmall)};
}

bool continues(std::string_view text, std::size_t at) {
  constexpr unsigned char kMask = 0xc0, kContinuation = 0x80;
  return at < text.size() && (static_cast<unsigned char>(text[at]) & kMask) == kContinuation;
}

}  // namespace

const MapTerm* find_map_term(std::string_view word, bool along_axis) {
  static const std::vector<MapTerm> kTerms = table_of_terms();
  const auto less = [](const MapTerm& term, std::string_view wanted) { return term.word < wanted; };
  auto found = std::lower_bound(kTerms.begin(), kTerms.end(), word, less);
  const MapTerm* any = nullptr;
  // Of an axis, the meaning that needs one comes first: the scale of x is a pitch, that of nothing one of the values.
  for (; found != kTerms.end() && found->word == word; ++found) {
    if (found->needs_axis && along_axis) return &*found;
    if (!found->needs_axis && !any) any = &*found;
  }
  return any;
}

std::string fold_letters(std::string_view text) {
  constexpr unsigned char kTwoBytes = 0xc3, kLatin = 0x40;
  std::string folded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    std::string_view letter;
    const std::string small =
        continues(text, i + 1) ? small_cyrillic(c, static_cast<unsigned char>(text[i + 1])) : std::string();
    if (!small.empty()) {
      letter = small;
      ++i;
    } else if (c == kTwoBytes && continues(text, i + 1)) {
      letter = ascii_of(static_cast<unsigned char>(text[i + 1]) + kLatin);
      if (!letter.empty()) ++i;
    } else if (c >= kTwoBytes && !continues(text, i + 1)) {
      letter = ascii_of(c);
    }
    if (letter.empty()) {
      folded += lower_case(text.substr(i, 1));
    } else {
      folded += letter;
    }
  }
  return folded;
}

bool is_value_word(std::string_view word) { return is_among(word, kValueWords); }

bool is_value_of_unit(std::string_view word) { return is_value_word(word) || is_among(word, kValuesBeforeUnit); }

bool is_lateral_of_unit(std::string_view word) { return is_among(word, kLateralsBeforeUnit); }

bool is_unit_name(std::string_view word) {
  constexpr std::array<std::string_view, 32> kUnits{
      "unit",
      "units",
      "uom",
      "einheit",
      "einheiten",
      "unite",
      "unites",
      "masseinheit",
      "unidad",
      "unidades",
      "unita",
      "unidade",
      "eenheid",
      "eenheden",
      "enhet",
      "enheter",
      "jednostka",
      "jednostki",
      "jednotka",
      "jednotky",
      "birim",
      "egyseg",
      "yksikko",
      "\xd0\xb5\xd0\xb4\xd0\xb8\xd0\xbd\xd0\xb8\xd1\x86\xd0\xb0",  // Russian
      "\xd0\xb5\xd0\xb4\xd0\xb8\xd0\xbd\xd0\xb8\xd1\x86\xd1\x8b",  // Russian, of several
      "\xd0\xb5\xd0\xb4",                                          // the same, short
      "\xd0\xb5\xd0\xb4\xd0\xb8\xd0\xbd\xd0\xb8\xd1\x86\xd1\x96",  // Ukrainian
      "\xe5\x8d\x95\xe4\xbd\x8d",                                  // Chinese
      "\xe5\x96\xae\xe4\xbd\x8d",                                  // Chinese, traditional letters
      "\xe5\x8d\x98\xe4\xbd\x8d",                                  // Japanese
      "\xeb\x8b\xa8\xec\x9c\x84",                                  // Korean
      "\xce\xbc\xce\xbf\xce\xbd\xce\xac\xce\xb4\xce\xb1"           // Greek
  };
  return is_among(word, kUnits);
}

std::string with_letter_times(std::string_view text) {
  constexpr std::string_view kTimes = "\xc3\x97";
  std::string plain(text);
  for (std::size_t at = 0; (at = plain.find(kTimes, at)) != std::string::npos;) plain.replace(at, kTimes.size(), " x ");
  return plain;
}

}  // namespace dwell

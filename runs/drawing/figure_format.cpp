#include "runs/drawing/figure_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

std::string format_words(const char* before_each) {
  std::string words;
  for (const FigureFormat format : figure_formats()) {
    words += fmt::format("{}{}{}", words.empty() ? "" : ", ", before_each, to_string(format));
  }
  return words;
}

/// The end of the list if the word names none.
std::vector<FigureFormat>::const_iterator format_named(std::string_view word) {
  const auto& all = figure_formats();
  return std::find_if(all.begin(), all.end(), [&](FigureFormat format) { return to_string(format) == word; });
}

}  // namespace

const std::vector<FigureFormat>& figure_formats() {
  static const std::vector<FigureFormat> kFormats{FigureFormat::Png, FigureFormat::Svg, FigureFormat::Pdf};
  return kFormats;
}

std::string_view to_string(FigureFormat format) {
  switch (format) {
    case FigureFormat::Png:
      return "png";
    case FigureFormat::Svg:
      return "svg";
    case FigureFormat::Pdf:
      return "pdf";
  }
  return "";
}

std::vector<FigureFormat> parse_figure_formats(std::string_view text) {
  std::vector<FigureFormat> formats;
  for (const std::string_view part : split(text, ',')) {
    const std::string_view word = trim(part);
    const auto found = format_named(word);
    if (found == figure_formats().end()) {
      throw InputError(fmt::format("figures '{}': '{}' is no format; accepted: {}, or several separated by commas",
                                   text, word, format_words("")));
    }
    if (std::find(formats.begin(), formats.end(), *found) == formats.end()) formats.push_back(*found);
  }
  return formats;
}

FigureFormat figure_format_of_file(const std::string& name) {
  const std::string extension = lower_case(std::filesystem::path(name).extension().string());
  const auto found = extension.empty() ? figure_formats().end() : format_named(extension.substr(1));
  if (found == figure_formats().end()) {
    throw InputError(fmt::format("'{}': extension '{}'; accepted: {}", name, extension, figure_extensions()));
  }
  return *found;
}

std::string figure_extensions() { return format_words("."); }

FigureRange parse_figure_range(std::string_view text) {
  if (text == "shared") return FigureRange::Shared;
  if (text == "own") return FigureRange::Own;
  throw InputError(fmt::format("'{}'; accepted: shared, own", text));
}

std::string to_string(const std::vector<FigureFormat>& formats) {
  std::string text;
  for (const FigureFormat format : formats) text += (text.empty() ? "" : ",") + std::string(to_string(format));
  return text;
}

std::string_view to_string(FigureRange range) { return range == FigureRange::Shared ? "shared" : "own"; }

}  // namespace dwell

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// The kind of file that a figure is written to.
///   Png  pixels, two for each unit of length of the figure, for the screen and for slides
///   Svg  lines as vectors, text as outlines with the words laid over them, for web pages
///   Pdf  lines as vectors and real text, for papers
/// In the last two, the field of a map is an image within the figure.
enum class FigureFormat { Png, Svg, Pdf };

/// Every format, in the order of the enumeration.
const std::vector<FigureFormat>& figure_formats();

/// "png", "svg" or "pdf": the word for it, and the extension of its files.
std::string_view to_string(FigureFormat format);

/// The formats of a list like "png,svg", each once, in the order given. Throws InputError for a word that is none.
std::vector<FigureFormat> parse_figure_formats(std::string_view text);
std::string to_string(const std::vector<FigureFormat>& formats);

/// The format that the extension of a file's name says, in capitals or not. Throws InputError for another extension.
FigureFormat figure_format_of_file(const std::string& name);

/// ".png, .svg, .pdf", for messages.
std::string figure_extensions();

/// Whether two figures that belong together have their colours over one range.
///   Shared  the later one has the range of the earlier, and is drawn a second time over its own
///   Own     each has its own range
enum class FigureRange { Shared, Own };

/// Throws InputError unless the text is "shared" or "own".
FigureRange parse_figure_range(std::string_view text);
std::string_view to_string(FigureRange range);

}  // namespace dwell

#pragma once

#include <string>

namespace dwell {

/// How the machine spends the dwell times. Moving: it runs through, each dwell point over its stroke at one speed
/// (core/motion/tool_path.h, moving_strokes). Stop: it halts at each dwell point and runs between them at maximum feed
/// with the tool still at work, so those moves remove material too.
enum class Motion { Moving, Stop };

/// Parses "moving" or "stop". Throws InputError naming the text and the accepted words.
Motion parse_motion(const std::string& text);
std::string to_string(Motion motion);

}  // namespace dwell

#pragma once

#include <cstdint>

namespace dwell {

/// A colour of the screen (sRGB), eight bits a component.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// The colour as one number, 0xRRGGBB.
inline std::uint32_t packed(Colour c) {
  return static_cast<std::uint32_t>(c.red) << 16 | static_cast<std::uint32_t>(c.green) << 8 | c.blue;
}

/// The colours of text, background and grid lines of all figures.
inline constexpr Colour kInk{32, 32, 32};
inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kGridLines{222, 222, 222};

}  // namespace dwell

#include "runs/reports/motion_table.h"

#include <fmt/format.h>

#include <iterator>

#include "core/base/poll.h"
#include "core/base/utf8_text.h"
#include "core/base/version.h"

namespace dwell {
namespace {

/// A name on the line of a comment.
std::string on_one_line(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return with_escaped_bytes(name);
}

}  // namespace

std::string motion_table_text(const std::vector<MotionNode>& nodes, const std::string& program,
                              const std::string& machine, const Progress& progress) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# dwell {}: motion of a program on a machine\n", version());
  fmt::format_to(out, "# program: {}\n# machine: {}\n", on_one_line(program), on_one_line(machine));
  fmt::format_to(out, "# between two rows straight at constant acceleration; removes: 1 = at work up to this row\n");
  fmt::format_to(out, "t_s,x_mm,y_mm,speed_mm_per_s,removes\n");
  Poll poll(progress);
  for (const MotionNode& node : nodes) {
    poll.step();
    fmt::format_to(out, "{:.9f},{:.9f},{:.9f},{:.9f},{}\n", node.seconds, node.place.x, node.place.y, node.speed,
                   node.removes ? 1 : 0);
  }
  return fmt::to_string(text);
}

}  // namespace dwell

#include "runs/programs/gcode_block.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "runs/programs/axis_words.h"
#include "runs/programs/gcode_codes.h"

namespace dwell {
namespace {

PathMode::Kind path_mode_of(const GcodeCode& code) {
  constexpr int kExactPath = 610, kExactStop = 611;
  if (code.tenths == kExactPath) return PathMode::Kind::ExactPath;
  return code.tenths == kExactStop ? PathMode::Kind::ExactStop : PathMode::Kind::Blended;
}

// Collects one line.
class BlockCollector {
 public:
  BlockCollector(const GcodePlace& where, AxisLetters letters) : where_(where), letters_(letters) {}

  GcodeBlock collect(const GcodeLine& line) {
    for (const GcodeWord& word : line.words) {
      if (word.letter == 'G' || word.letter == 'M') {
        take_code(word);
      } else {
        take_word(word);
      }
    }
    check_company(line);
    take_tolerances();
    return block_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_.text() + ": " + what); }

  [[noreturn]] void refuse(const GcodeWord& word, std::string_view why) const {
    fail(fmt::format("\"{}\": {}", word.text, why));
  }

  template <typename Value>
  void once(std::optional<Value>& slot, Value value, const GcodeWord& word) const {
    if (slot) refuse(word, "is the second word of its kind on this line; accepted: one");
    slot = value;
  }

  void take_word(const GcodeWord& word) {
    if (word.letter == letters_.x) return once(block_.x, word.value, word);
    if (word.letter == letters_.y) return once(block_.y, word.value, word);
    if (const std::string why_not = why_no_axis(word.letter, letters_); !why_not.empty()) refuse(word, why_not);
    switch (word.letter) {
      case 'Z':
        return once(block_.z, word.value, word);
      case 'F':
        return once(block_.f, word.value, word);
      case 'P':
        return once(block_.p, word, word);
      case 'Q':
        return once(q_, word, word);
      case 'S':
        return once(block_.s, word.value, word);
      case 'T':
        return once(block_.tool, word.value, word);
      case 'O':
        block_.numbered = true;
        return once(o_, word, word);
      case 'N':
        return;
      default:
        break;
    }
    const std::string_view why = refused_letter(word.letter);
    if (!why.empty() && kAxisLetters.find(word.letter) != std::string_view::npos) {
      refuse(word, fmt::format("{}; if an axis of the part's plane is called so, a `machine` file that says its letter",
                               why));
    }
    if (!why.empty()) refuse(word, why);
    fail(fmt::format("word \"{}\" is not known; {}", word.text, accepted_gcode()));
  }

  void take_code(const GcodeWord& word) {
    const GcodeCode* code = gcode_code(word.letter, word.value);
    if (code == nullptr) fail(fmt::format("word \"{}\" is not known; {}", word.text, accepted_gcode()));
    constexpr int kTenths = 10;
    const int number = code->tenths / kTenths;
    switch (code->effect) {
      case GcodeEffect::None:
        return;
      case GcodeEffect::Cancel:
        cancels_ = word;
        return;
      case GcodeEffect::Motion:
        return once(block_.motion, number, word);
      case GcodeEffect::Halt:
        block_.halt = true;
        return;
      case GcodeEffect::Distance:
        return once(block_.incremental, number == 91, word);
      case GcodeEffect::FeedMode:
        return once(block_.feed_mode, number, word);
      case GcodeEffect::Inches:
      case GcodeEffect::Millimetres:
        return take_unit(code->effect == GcodeEffect::Inches, word);
      case GcodeEffect::WorkOffset:
        return once(block_.work_offset, code->tenths, word);
      case GcodeEffect::PathMode:
        return once(block_.path_mode, PathMode{path_mode_of(*code)}, word);
      default:
        take_machine_code(*code, number, word);
    }
  }

  // G21 twice, or beside G71, says one thing.
  void take_unit(bool inches, const GcodeWord& word) {
    if (block_.inches && *block_.inches != inches) refuse(word, "is a second unit on this line; accepted: one");
    block_.inches = inches;
  }

  // Codes that switch something of the machine.
  void take_machine_code(const GcodeCode& code, int number, const GcodeWord& word) {
    switch (code.effect) {
      case GcodeEffect::Pause:
        block_.pause = true;
        return;
      case GcodeEffect::End:
        block_.end = true;
        return;
      case GcodeEffect::Spindle:
        return once(block_.spindle, number, word);
      case GcodeEffect::Coolant:
        block_.mist = block_.mist || number == 7;
        block_.flood = block_.flood || number == 8;
        block_.coolants_off = block_.coolants_off || number == 9;
        return;
      case GcodeEffect::ToolChange:
        block_.change_tool = true;
        return;
      default:
        refuse(word, code.about);
    }
  }

  // What may stand beside what.
  void check_company(const GcodeLine& line) const {
    if (o_ && line.words.size() > 1) {
      refuse(*o_, "a program's number stands alone; calls and loops (O with more on its line) are not honoured");
    }
    if (cancels_ && block_.has_axes()) {
      refuse(*cancels_, "beside X, Y or Z controllers disagree on it; required on a line of its own");
    }
    const bool blended = block_.path_mode && block_.path_mode->kind == PathMode::Kind::Blended;
    if (block_.p && !block_.halt && !blended) {
      refuse(*block_.p, "P without G4; accepted only as the time of a halt (G4 P0.5) and the tolerance of G64");
    }
    if (q_ && !blended) refuse(*q_, "Q is accepted only as a tolerance of G64");
    if (block_.halt) check_halt();
  }

  // P and Q of G64.
  void take_tolerances() {
    if (!block_.path_mode || block_.halt) return;
    const auto tolerance = [this](const std::optional<GcodeWord>& word) -> std::optional<double> {
      if (!word) return std::nullopt;
      if (!(word->value >= 0.0)) refuse(*word, "a tolerance of G64; required >= 0");
      return word->value;
    };
    block_.path_mode->tolerance_mm = tolerance(block_.p);
    block_.path_mode->merging_mm = tolerance(q_);
  }

  void check_halt() const {
    if (block_.has_axes() || block_.motion) {
      fail("G4 together with a move; required on a line of its own, its time as P (G4 X is not accepted as one)");
    }
    if (block_.f || block_.s) {
      fail("G4 with F or S: a time or a number of turns on some controllers; required G4 P");
    }
    if (block_.path_mode) fail("G4 together with G61 or G64, whose P it would be; required on a line of its own");
  }

  const GcodePlace& where_;
  AxisLetters letters_;
  GcodeBlock block_;
  std::optional<GcodeWord> q_, o_, cancels_;
};

}  // namespace

GcodeBlock collect_gcode_block(const GcodeLine& line, const GcodePlace& where, AxisLetters letters) {
  return BlockCollector(where, letters).collect(line);
}

}  // namespace dwell

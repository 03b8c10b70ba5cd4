#pragma once

#include <string>
#include <string_view>

#include "core/motion/program_frame.h"
#include "runs/programs/gcode_reading.h"
#include "runs/programs/gcode_words.h"

namespace dwell {

/// What the comments of a program say of how it is to be read. Our own say "(dwell: gcode=..., g4=...)" and "(dwell:
/// zero=... rotate=... swap=...)" (frame_text); any other may speak of a unit or of axes, and is refused if these are
/// not those of the program.
class GcodeRemarks {
 public:
  explicit GcodeRemarks(const GcodeReading& reading) : reading_(reading) {}

  /// How far a program has come at a comment.
  struct Reached {
    bool inches = false;  // G20 holds
    bool placed = false;  // a coordinate was read
  };

  /// Takes a comment. Throws InputError that begins with the place and names what is accepted: an entry of ours that
  /// is not known, contradicts the reading or comes too late, another unit, other axes.
  void take(std::string_view comment, const GcodePlace& where, const Reached& reached);

  /// Before a length is read: throws InputError if a comment before the first said inches and that is in millimetres.
  void check_unit(bool inches);

  const GcodeReading& reading() const { return reading_; }
  const ProgramFrame& frame() const { return frame_; }

 private:
  void take_entries(std::string_view entries, const GcodePlace& where);
  void take_dialect(const std::string& text, const GcodePlace& where);
  void take_halt_unit(std::string_view entry, const GcodePlace& where);
  void take_frame(std::string_view text, const GcodePlace& where, const Reached& reached);
  void check_remark(std::string_view comment, const GcodePlace& where, const Reached& reached);

  GcodeReading reading_;
  ProgramFrame frame_;
  bool says_frame_ = false;
  std::string inches_said_;  // the refusal of a comment that says inches, should the program not be in them
};

}  // namespace dwell

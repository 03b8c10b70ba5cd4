#pragma once

#include <string>

namespace dwell::cli {

/// Keeps the numbers of standard streams that are closed from the files that are opened later: what is printed would
/// go into the first file that is written. Writing to them fails as before. At the start of the program.
void hold_standard_streams();

/// Says something on standard error, and nothing where nobody reads. From any thread. Waits for a reader that has
/// stalled (a full pipe) for so many milliseconds at most, -1 for ever.
void say(const std::string& text, int patience_ms = -1);

/// Puts text to standard output. What cannot be written, finish_output() says at the end.
void print(const std::string& text);

/// Sends off what was printed to standard output. False, and said on standard error, if it could not all be written
/// (a full device, closed): then the answer is lost. For the end of the program.
bool finish_output();

}  // namespace dwell::cli

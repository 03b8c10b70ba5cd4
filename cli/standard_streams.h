#pragma once

#include <string>

namespace dwell::cli {

/// Occupies the numbers of standard streams that are closed. Otherwise the first file to be opened would get such a
/// number, and what the program prints would go into that file. Writing to these streams fails as before. Call it at
/// the start of the program.
void hold_standard_streams();

/// Writes a text to standard error, or nothing if nobody reads there. Bytes that are no UTF-8 (of names of files) are
/// shown as \xE9. May be called from any thread. Waits for a reader
/// that has stalled (a full pipe) for at most `patience_ms` milliseconds; -1 is for ever.
void say(const std::string& text, int patience_ms = -1);

/// Puts text to standard output, bytes that are no UTF-8 likewise. What cannot be written, finish_output() says at the
/// end.
void print(const std::string& text);

/// Flushes standard output, at the end of the program. If not all of it could be written (a full device, a closed
/// stream), the answer is lost: it says so on standard error and returns false.
bool finish_output();

}  // namespace dwell::cli

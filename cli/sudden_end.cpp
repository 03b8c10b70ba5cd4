#include "cli/sudden_end.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "cli/out_of_memory.h"
#include "cli/standard_streams.h"
#include "cli/terminal.h"
#include "core/base/unfinished_output.h"

namespace dwell::cli {
namespace {

void give_up_at_exit() { give_up_outputs(); }

/// What was thrown, as far as it can be known.
std::string why_terminated() {
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) return "internal fault: ended without an exception";
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return out_of_memory_message();
  } catch (const std::exception& error) {
    return std::string("internal fault: ") + error.what();
  } catch (...) {
    return "internal fault: an exception of an unknown kind";
  }
}

[[noreturn]] void end_after_terminate() {
  give_up_outputs();
  try {
    say("dwell: " + why_terminated() + "\n", 100);
  } catch (...) {
    _exit(kInternalFault);  // without words: there is no memory for them
  }
  _exit(kInternalFault);
}

}  // namespace

void leave_nothing_at_a_sudden_end() {
  std::atexit(give_up_at_exit);
  std::set_terminate(end_after_terminate);
}

}  // namespace dwell::cli

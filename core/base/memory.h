#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace dwell {

/// The machine has not the memory that a computation takes. Not the user's fault as such (InputError): the same job
/// runs on a larger machine. The command line turns it into exit code 1.
class OutOfMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The address space of this process [bytes]; 0 if the system does not say.
std::size_t address_space_in_use();

/// What this process may still take [bytes]: the least of what the system has free, what its control group leaves and
/// what its own limit of address space leaves. Without an answer of the system, the largest number there is.
std::size_t memory_to_be_had();

/// Throws OutOfMemory if `bytes` are more than memory_to_be_had(). `what` says what takes them, as the subject of the
/// sentence: "a plan of 4096 x 4096 pixels". For an amount that is taken for certain, before the work begins.
void require_memory(double bytes, const std::string& what);

}  // namespace dwell

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

namespace dwell {

/// What a child process may use.
struct ChildLimits {
  double cpu_seconds = 0.0;  // to whole seconds, at least one
  std::size_t bytes = 0;  // of memory, besides what this process has; no limit under a sanitizer, which takes terabytes
};

/// The answer of a child process, in memory that was its own.
class ChildAnswer {
 public:
  /// Takes over `size` bytes from mmap; none if there are none.
  ChildAnswer(void* bytes, std::size_t size) : bytes_(bytes), size_(size) {}
  ChildAnswer(ChildAnswer&& other) noexcept;
  ChildAnswer& operator=(ChildAnswer&&) = delete;
  ~ChildAnswer();

  std::string_view bytes() const { return {static_cast<const char*>(bytes_), size_}; }

 private:
  void* bytes_;
  std::size_t size_;
};

/// Appends bytes to the answer.
using AnswerSink = std::function<void(std::string_view)>;

/// What `work` answers, done in a copy of this process; nothing if the copy came to harm: it crashed or went beyond its
/// limits. What it changes stays in the copy, and what it prints to standard error is lost. `work` must not use threads
/// (they are not copied) and must not throw.
/// Throws std::runtime_error if the system makes no process. Cost: a fork, and a copy of the answer.
std::optional<ChildAnswer> output_of_child(const std::function<void(const AnswerSink&)>& work,
                                           const ChildLimits& limits);

}  // namespace dwell

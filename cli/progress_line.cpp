#include "cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <new>

#include "cli/standard_streams.h"

namespace dwell::cli {
namespace {

constexpr auto kLook = std::chrono::milliseconds(250);
constexpr auto kNews = std::chrono::seconds(1);
constexpr auto kStill = std::chrono::seconds(10);  // without news, where every line stays

std::atomic<bool> line_open = false;

/// Of the process: there is one standard error.
std::weak_ptr<ProgressLine>& current() {
  static std::weak_ptr<ProgressLine> line;
  return line;
}

struct News {
  std::mutex mutex;
  std::string text;
};

/// Never destroyed: the process may end while a thread still works.
News& newest() {
  static auto* const kNewest = new News;
  return *kNewest;
}

}  // namespace

ProgressLine::ProgressLine()
    : in_place_(isatty(STDERR_FILENO) != 0), last_(Clock::now()), thread_([this] { watch(); }) {}

ProgressLine::~ProgressLine() {
  clear();
  {
    const std::scoped_lock lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void ProgressLine::show(const std::string& line) {
  {
    const std::scoped_lock lock(newest().mutex);
    newest().text = line;
  }
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  line_ = line;
  shown_ = false;
  since_ = now;
  print_if_due(now);
}

void ProgressLine::clear() {
  const std::scoped_lock lock(mutex_);
  line_.clear();
  if (open_) say("\r\x1b[K", 0);
  open_ = line_open = false;
}

void ProgressLine::watch() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kLook, [this] { return end_; })) {
    try {
      print_if_due(Clock::now());
    } catch (const std::bad_alloc&) {
      // Out of memory is for the thread that works to tell: a line less.
    }
  }
}

void ProgressLine::print_if_due(Clock::time_point now) {
  const auto patience = shown_ && !in_place_ ? kStill : kNews;
  if (line_.empty() || now - last_ < patience) return;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now - since_).count();
  const std::string text = seconds > 0 && shown_ ? fmt::format("{} ({} s)", line_, seconds) : line_;
  say(in_place_ ? "\r\x1b[K" + text : text + "\n", 0);
  open_ = line_open = in_place_;
  shown_ = true;
  last_ = now;
}

void finish_progress() {
  if (const auto line = current().lock()) line->clear();
}

std::string latest_news() {
  const std::scoped_lock lock(newest().mutex);
  return newest().text;
}

bool progress_line_is_open() { return line_open; }

std::shared_ptr<ProgressLine> progress_line() {
  auto line = current().lock();
  if (!line) {
    line = std::make_shared<ProgressLine>();
    current() = line;
  }
  return line;
}

}  // namespace dwell::cli

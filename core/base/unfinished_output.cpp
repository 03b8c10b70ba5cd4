#include "core/base/unfinished_output.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dwell {
namespace {

namespace fs = std::filesystem;

struct Registry {
  std::recursive_mutex mutex;
  std::vector<const UnfinishedOutput*> outputs;  // in the order in which they were made
  bool result_in_place = false;
};

/// Never destroyed: a thread may still write while static objects go.
Registry& registry() {
  static auto* const kRegistry = new Registry;
  return *kRegistry;
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  const std::string inner = path.string(), outer = folder.string() + "/";
  return inner.starts_with(outer);
}

}  // namespace

UnfinishedOutput::UnfinishedOutput(Kind kind, const std::function<fs::path()>& make) : kind_(kind) {
  const std::scoped_lock lock(registry().mutex);
  path_ = make();
  registry().outputs.push_back(this);
}

UnfinishedOutput::~UnfinishedOutput() {
  const std::scoped_lock lock(registry().mutex);
  remove();
  std::erase(registry().outputs, this);
}

void UnfinishedOutput::put_in_place(const fs::path& target, const std::function<void()>& rename) {
  Registry& all = registry();
  const std::scoped_lock lock(all.mutex);
  rename();
  gone_ = kind_ == Kind::File;
  const bool inside = std::any_of(all.outputs.begin(), all.outputs.end(),
                                  [&](const UnfinishedOutput* other) { return lies_in(target, other->path()); });
  all.result_in_place = all.result_in_place || !inside;
}

void UnfinishedOutput::remove() const {
  std::error_code ignored;
  if (gone_) return;
  if (kind_ == Kind::Folder) {
    fs::remove_all(path_, ignored);
  } else {
    fs::remove(path_, ignored);
  }
}

OutputGroup::OutputGroup() { registry().mutex.lock(); }

OutputGroup::~OutputGroup() { registry().mutex.unlock(); }

bool give_up_outputs() {
  Registry& all = registry();
  all.mutex.lock();  // and kept, if it comes to that
  if (all.result_in_place) {
    all.mutex.unlock();
    return false;
  }
  for (auto output = all.outputs.rbegin(); output != all.outputs.rend(); ++output) (*output)->remove();
  return true;
}

}  // namespace dwell

#include "tests/architecture/concepts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace dwell::architecture {
namespace {

std::string without_ending(const std::string& path) { return path.substr(0, path.rfind('.')); }

/// The longest beginning of the file's name, cut at underscores, that a header has; or else its own.
std::string concept_of(const std::string& path, const std::set<std::string>& headers) {
  const std::string own = without_ending(path);
  const std::size_t name_begin = own.rfind('/') + 1;
  for (std::size_t end = own.size(); end != std::string::npos && end > name_begin; end = own.rfind('_', end - 1)) {
    if (headers.contains(own.substr(0, end))) return own.substr(0, end);
  }
  return own;
}

/// Tarjan's strongly connected components.
class Components {
 public:
  explicit Components(const ConceptGraph& graph) : graph_(graph) {
    for (const auto& [name, targets] : graph) {
      if (!order_.contains(name)) visit(name);
    }
  }

  const std::vector<std::vector<std::string>>& found() const { return found_; }

 private:
  void visit(const std::string& name) {
    order_[name] = lowest_[name] = static_cast<int>(order_.size());
    stack_.push_back(name);
    waiting_.insert(name);
    for (const std::string& target : graph_.at(name)) {
      if (!order_.contains(target)) {
        visit(target);
        lowest_[name] = std::min(lowest_[name], lowest_[target]);
      } else if (waiting_.contains(target)) {
        lowest_[name] = std::min(lowest_[name], order_[target]);
      }
    }
    if (lowest_[name] == order_[name]) take_component(name);
  }

  void take_component(const std::string& root) {
    const auto begin = std::find(stack_.begin(), stack_.end(), root);
    std::vector<std::string> component(begin, stack_.end());
    stack_.erase(begin, stack_.end());
    for (const std::string& name : component) waiting_.erase(name);
    std::sort(component.begin(), component.end());
    found_.push_back(std::move(component));
  }

  const ConceptGraph& graph_;
  std::map<std::string, int> order_, lowest_;
  std::vector<std::string> stack_;
  std::set<std::string> waiting_;
  std::vector<std::vector<std::string>> found_;
};

}  // namespace

ConceptGraph concept_graph(const std::vector<SourceFile>& files) {
  std::set<std::string> headers, paths;
  for (const SourceFile& file : files) {
    paths.insert(file.path);
    if (file.path.ends_with(".h")) headers.insert(without_ending(file.path));
  }
  ConceptGraph graph;
  for (const SourceFile& file : files) {
    const std::string from = concept_of(file.path, headers);
    std::set<std::string>& targets = graph[from];
    for (const Include& include : includes_of(file.text)) {
      if (!paths.contains(include.target)) continue;
      const std::string to = concept_of(include.target, headers);
      if (to != from) targets.insert(to);
    }
  }
  return graph;
}

std::size_t arrows(const ConceptGraph& graph) {
  std::size_t count = 0;
  for (const auto& [name, targets] : graph) count += targets.size();
  return count;
}

std::vector<std::vector<std::string>> circles(const ConceptGraph& graph) {
  std::vector<std::vector<std::string>> found = Components(graph).found();
  std::erase_if(found, [](const auto& component) { return component.size() < 2; });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Violation> check_circles(const std::vector<SourceFile>& files) {
  std::vector<Violation> violations;
  for (const std::vector<std::string>& circle : circles(concept_graph(files))) {
    violations.push_back({circle.front(), 0, fmt::format("a circle of concepts: {}", fmt::join(circle, ", "))});
  }
  return violations;
}

}  // namespace dwell::architecture

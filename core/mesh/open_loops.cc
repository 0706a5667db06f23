#include "core/mesh/open_loops.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace capfit::mesh {
namespace {

constexpr std::uint32_t kNotOnPath = 0xFFFFFFFFu;

// Takes the open half-edges apart into loops that visit no vertex twice.
class LoopFinder {
 public:
  explicit LoopFinder(const Surface& surface) : surface_(surface) {
    for (HalfEdge h = 0; h < surface.mate.size(); ++h) {
      if (surface.mate[h] == kNoMate) by_start_.emplace_back(Start(h), h);
    }
    std::sort(by_start_.begin(), by_start_.end());
    std::uint32_t highest = 0;
    for (const auto& [start, h] : by_start_) highest = std::max({highest, start, End(h)});
    next_unused_.assign(std::size_t{highest} + 1, 0);
    place_on_path_.assign(std::size_t{highest} + 1, kNotOnPath);
    for (std::size_t i = by_start_.size(); i-- > 0;) next_unused_[by_start_[i].first] = i;
    used_.assign(by_start_.size(), false);
  }

  std::optional<std::vector<OpenLoop>> Run() {
    for (std::size_t i = 0; i < by_start_.size(); ++i) {
      if (!used_[i] && !WalkFrom(by_start_[i].first)) return std::nullopt;
    }
    return std::move(loops_);
  }

 private:
  [[nodiscard]] std::uint32_t Start(HalfEdge h) const { return StartOf(surface_.triangles, h); }
  [[nodiscard]] std::uint32_t End(HalfEdge h) const { return EndOf(surface_.triangles, h); }

  // Walks until the path is used up, cutting off each loop as soon as it closes. False where the
  // walk gets stuck: the open edges do not form loops.
  bool WalkFrom(std::uint32_t vertex) {
    while (true) {
      const std::optional<HalfEdge> h = TakeFrom(vertex);
      if (!h.has_value()) return path_.empty();
      place_on_path_[vertex] = static_cast<std::uint32_t>(path_.size());
      path_.push_back(*h);
      vertex = End(*h);
      if (place_on_path_[vertex] != kNotOnPath) CutOffLoop(place_on_path_[vertex]);
    }
  }

  std::optional<HalfEdge> TakeFrom(std::uint32_t vertex) {
    std::size_t& i = next_unused_[vertex];
    if (i >= by_start_.size() || by_start_[i].first != vertex) return std::nullopt;
    used_[i] = true;
    return by_start_[i++].second;
  }

  void CutOffLoop(std::uint32_t place) {
    loops_.emplace_back(path_.begin() + place, path_.end());
    for (const HalfEdge h : loops_.back()) place_on_path_[Start(h)] = kNotOnPath;
    path_.resize(place);
  }

  const Surface& surface_;
  std::vector<std::pair<std::uint32_t, HalfEdge>> by_start_;
  std::vector<std::size_t> next_unused_;  // of a vertex: index into by_start_
  std::vector<std::uint32_t> place_on_path_;
  std::vector<bool> used_;
  OpenLoop path_;
  std::vector<OpenLoop> loops_;
};

}  // namespace

std::optional<std::vector<OpenLoop>> FindOpenLoops(const Surface& surface) {
  return LoopFinder(surface).Run();
}

}  // namespace capfit::mesh

#include "validate/stream/judge_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace clues::validate {
namespace {

using scene::StreamMessage;
using scene::StreamTriangle;

// Bit for bit: -0 is not 0.
bool same_bits(const scene::Point& a, const scene::Point& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

class StreamJudge {
 public:
  StreamJudge(const scene::TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbours,
              const CellTruth& truth, std::size_t most)
      : neighbours_(neighbours), truth_(truth), most_(most), client_(mesh) {}

  StreamVerdict run(const std::vector<StreamMessage>& messages) {
    for (const StreamMessage& message : messages) {
      ++number_;
      for (const std::string& what : client_.apply(message)) add({number_, what, {}});
      verdict_.sent += message.plus.size();
      verdict_.taken += message.minus.size();
      verdict_.most_held = std::max<std::uint64_t>(verdict_.most_held, client_.size());
      verdict_.contours += message.contours.size();
      if (message.kind == StreamMessage::Kind::cell) {
        enter(message.cell);
      } else if (cell_ && message.kind == StreamMessage::Kind::minus) {
        require_visible(*cell_, "is taken away");
      } else if (cell_ && client_.has_contour(*cell_)) {
        require_visible(*cell_, "is not there");  // a contour may be new, or what is sent be at its boundary
      }
      if (verdict_.findings.size() >= most_) break;
    }
    return std::move(verdict_);
  }

 private:
  void add(StreamFinding finding) {
    if (verdict_.findings.size() < most_) verdict_.findings.push_back(std::move(finding));
  }

  void enter(std::uint32_t cell) {
    ++verdict_.cells_entered;
    if (cell_ && *cell_ != cell && !std::binary_search(neighbours_[*cell_].begin(), neighbours_[*cell_].end(), cell))
      add({number_, fmt::format("cell {} is no neighbour of cell {}", cell, *cell_), {}});
    if (cell_) require_visible(*cell_, "is not there on the face to the next cell");
    cell_ = cell;
    require_visible(cell, "is not there");
  }

  void require_visible(std::uint32_t cell, const char* how) {
    const Judgement& judgement = truth_(cell);
    const auto drawn = client_.drawn_in(cell);
    for (std::uint32_t t = 0; t < judgement.triangles.size(); ++t) {
      const bool seen = judgement.triangles[t] == TriangleVerdict::missing_visible;
      const bool open = judgement.triangles[t] == TriangleVerdict::missing_undecided;
      if ((!seen && !open) || (drawn ? drawn->contains(t) : client_.holds(t))) continue;
      if (open) {
        verdict_.undecided.push_back({number_, cell, t});
        continue;
      }
      StreamFinding finding{number_,
                            fmt::format("triangle {} is visible from cell {} and {}", t, cell,
                                        client_.holds(t) ? "its contour leaves it out" : how),
                            {}};
      const auto at = std::find_if(judgement.witnesses.begin(), judgement.witnesses.end(),
                                   [t](const Witness& w) { return w.triangle == t; });
      if (at != judgement.witnesses.end()) finding.witness = *at;
      add(std::move(finding));
    }
  }

  const std::vector<std::vector<std::uint32_t>>& neighbours_;
  const CellTruth& truth_;
  std::size_t most_;
  StreamClient client_;
  StreamVerdict verdict_;
  std::uint64_t number_ = 0;
  std::optional<std::uint32_t> cell_;
};

}  // namespace

std::vector<std::string> StreamClient::apply(const StreamMessage& message) {
  std::vector<std::string> wrong;
  if (message.kind == StreamMessage::Kind::plus) apply_plus(message, wrong);
  if (message.kind == StreamMessage::Kind::minus) apply_minus(message, wrong);
  if (message.kind == StreamMessage::Kind::contours) {
    contours_.clear();
    for (const auto& contour : message.contours) contours_[contour.cell] = contour;
  }
  return wrong;
}

std::optional<StreamClient::EdgeEnds> StreamClient::edge_of(const StreamTriangle& triangle, std::size_t k) const {
  const auto a = vertices_.find(triangle.corners[k]), b = vertices_.find(triangle.corners[(k + 1) % 3]);
  if (a == vertices_.end() || b == vertices_.end()) return std::nullopt;
  return EdgeEnds{std::min(a->second, b->second), std::max(a->second, b->second)};
}

std::optional<std::set<std::uint32_t>> StreamClient::drawn_in(std::uint32_t cell) const {
  const auto contour = contours_.find(cell);
  if (contour == contours_.end()) return std::nullopt;
  std::map<EdgeEnds, std::vector<std::uint32_t>> at_edge;  // passed by the flood
  for (const auto& [id, triangle] : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (const auto edge = edge_of(triangle, k)) at_edge[*edge].push_back(id);
    }
  }
  for (const std::uint64_t edge : contour->second.boundary) {
    const auto at = triangles_.find(static_cast<std::uint32_t>(edge / 3));
    if (at == triangles_.end()) continue;
    if (const auto ends = edge_of(at->second, edge % 3)) at_edge.erase(*ends);
  }
  std::set<std::uint32_t> drawn;
  std::vector<std::uint32_t> queue;
  const auto reach = [&](std::uint32_t id) {
    if (drawn.insert(id).second) queue.push_back(id);
  };
  for (const std::uint32_t seed : contour->second.seeds) {
    if (holds(seed)) reach(seed);
  }
  while (!queue.empty()) {
    const StreamTriangle& triangle = triangles_.at(queue.back());
    queue.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = edge_of(triangle, k);
      const auto at = edge ? at_edge.find(*edge) : at_edge.end();
      if (at == at_edge.end()) continue;
      for (const std::uint32_t next : at->second) reach(next);
    }
  }
  return drawn;
}

bool StreamClient::has_right_corner(std::uint32_t id, std::size_t corner) const {
  const auto at = vertices_.find(triangles_.at(id).corners[corner]);
  return at != vertices_.end() && same_bits(at->second, mesh_->points[mesh_->triangles[id][corner]]);
}

void StreamClient::look_at_corners(std::uint32_t id) {
  if (has_right_corner(id, 0) && has_right_corner(id, 1) && has_right_corner(id, 2)) {
    astray_.erase(id);
  } else {
    astray_.insert(id);
  }
}

void StreamClient::put(const StreamTriangle& triangle) {
  slots_[triangle.slot] = triangle.triangle;
  triangles_[triangle.triangle] = triangle;
  for (const std::uint32_t slot : triangle.corners) {
    users_[slot].insert(triangle.triangle);
    idle_.erase(slot);
  }
  look_at_corners(triangle.triangle);
}

void StreamClient::take_away(std::uint32_t id) {
  const auto at = triangles_.find(id);
  slots_.erase(at->second.slot);
  for (const std::uint32_t slot : at->second.corners) {
    const auto users = users_.find(slot);
    if (users == users_.end()) continue;  // two corners in one slot
    users->second.erase(id);
    if (!users->second.empty()) continue;
    users_.erase(users);
    if (vertices_.contains(slot)) idle_.insert(slot);
  }
  triangles_.erase(at);
  astray_.erase(id);
}

void StreamClient::require_used(std::vector<std::string>& wrong) const {
  for (const std::uint32_t slot : idle_)
    wrong.push_back(fmt::format("slot {} is used by no triangle, and is not called unused", slot));
}

void StreamClient::apply_plus(const StreamMessage& message, std::vector<std::string>& wrong) {
  for (const scene::StreamVertex& v : message.vertices) {
    if (v.slot == 0 || vertices_.contains(v.slot))
      wrong.push_back(fmt::format("a vertex is sent into slot {}, which is in use", v.slot));
    vertices_[v.slot] = v.at;
    // Also of triangles that were there, because a vertex that is sent into the wrong slot changes them.
    const auto users = users_.find(v.slot);
    if (users == users_.end()) {
      idle_.insert(v.slot);
    } else {
      for (const std::uint32_t id : users->second) look_at_corners(id);
    }
  }
  for (const scene::StreamTriangle& t : message.plus) {
    if (triangles_.contains(t.triangle)) {
      wrong.push_back(fmt::format("triangle {} is sent, and is there already", t.triangle));
      continue;
    }
    if (t.slot == 0 || slots_.contains(t.slot))
      wrong.push_back(fmt::format("triangle {} is sent into slot {}, which is in use", t.triangle, t.slot));
    put(t);
  }
  for (const std::uint32_t id : astray_) {
    const std::size_t corner = !has_right_corner(id, 0) ? 0 : !has_right_corner(id, 1) ? 1 : 2;
    wrong.push_back(fmt::format("corner {} of triangle {} is not that of the scene", corner, id));
  }
  require_used(wrong);
}

void StreamClient::apply_minus(const StreamMessage& message, std::vector<std::string>& wrong) {
  for (const std::uint32_t t : message.minus) {
    if (triangles_.contains(t)) {
      take_away(t);
    } else {
      wrong.push_back(fmt::format("triangle {} is taken away, and is not there", t));
    }
  }
  for (const std::uint32_t slot : message.unused) {
    if (vertices_.erase(slot) == 0) wrong.push_back(fmt::format("slot {} is called unused, and is so already", slot));
    idle_.erase(slot);
    if (const auto users = users_.find(slot); users != users_.end())
      astray_.insert(users->second.begin(), users->second.end());
  }
  for (const std::uint32_t id : astray_) {
    for (const std::uint32_t slot : triangles_.at(id).corners) {
      if (!vertices_.contains(slot))
        wrong.push_back(fmt::format("slot {} is called unused, and triangle {} uses it", slot, id));
    }
  }
  require_used(wrong);
}

std::string StreamClient::bytes() const {
  std::string text;
  for (const auto& [slot, id] : slots_) {
    const auto& c = triangles_.at(id).corners;
    text += fmt::format("t {} {} {} {} {}\n", slot, id, c[0], c[1], c[2]);
  }
  for (const auto& [slot, at] : vertices_) {
    StreamMessage one;
    one.kind = StreamMessage::Kind::plus;
    one.vertices.push_back({slot, at});
    text += scene::to_line(one);
  }
  return text;
}

StreamVerdict judge_stream(const scene::TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbours,
                           const std::vector<StreamMessage>& messages, const CellTruth& truth,
                           std::size_t most_findings) {
  return StreamJudge(mesh, neighbours, truth, most_findings).run(messages);
}

}  // namespace clues::validate

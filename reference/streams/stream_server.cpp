#include "reference/streams/stream_server.h"

#include <algorithm>
#include <utility>

#include "reference/delta/delta.h"
#include "reference/streams/client_contours.h"
#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::reference {

using scene::StreamMessage;

std::uint32_t Slots::take() {
  if (free_.empty()) return next_++;
  const std::uint32_t slot = *free_.begin();
  free_.erase(free_.begin());
  return slot;
}

std::vector<std::uint32_t> DisplayList::triangles() const {
  std::vector<std::uint32_t> out;
  for (const auto& [id, unused] : triangles_) out.push_back(id);
  return out;
}

StreamMessage DisplayList::plus(const std::vector<std::uint32_t>& triangles) {
  StreamMessage message;
  message.kind = StreamMessage::Kind::plus;
  for (const std::uint32_t t : triangles) {
    scene::StreamTriangle sent{t, triangle_slots_.take(), {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh_->triangles[t][i];
      Vertex& vertex = vertices_[v];
      if (vertex.users == 0) {
        vertex.slot = vertex_slots_.take();
        message.vertices.push_back({vertex.slot, mesh_->points[v]});
      }
      ++vertex.users;
      sent.corners[i] = vertex.slot;
    }
    triangles_[t] = sent;
    message.plus.push_back(sent);
  }
  return message;
}

StreamMessage DisplayList::minus(const std::vector<std::uint32_t>& triangles) {
  StreamMessage message;
  message.kind = StreamMessage::Kind::minus;
  for (const std::uint32_t t : triangles) {
    triangle_slots_.give_back(triangles_.at(t).slot);
    triangles_.erase(t);
    message.minus.push_back(t);
    for (const std::uint32_t v : mesh_->triangles[t]) {
      const auto at = vertices_.find(v);
      if (--at->second.users > 0) continue;
      vertex_slots_.give_back(at->second.slot);
      message.unused.push_back(at->second.slot);
      vertices_.erase(at);
    }
  }
  return message;
}

std::string DisplayList::bytes() const {
  std::map<std::uint32_t, std::string> lines;
  for (const auto& [id, t] : triangles_) {
    lines[t.slot] = "t " + std::to_string(t.slot);
    for (const std::uint32_t x : {id, t.corners[0], t.corners[1], t.corners[2]})
      lines[t.slot].append(" ").append(std::to_string(x));
  }
  std::string text;
  for (const auto& [slot, line] : lines) text.append(line).append("\n");
  lines.clear();
  for (const auto& [v, vertex] : vertices_) {
    const scene::Point& p = mesh_->points[v];
    StreamMessage one;
    one.kind = StreamMessage::Kind::plus;
    one.vertices.push_back({vertex.slot, p});
    lines[vertex.slot] = scene::to_line(one);
  }
  for (const auto& [slot, line] : lines) text += line;
  return text;
}

StreamStore::StreamStore(const scene::TriangleMesh& mesh, std::vector<std::vector<std::uint32_t>> lists,
                         std::vector<std::vector<std::uint32_t>> neighbours, int horizon, CellTree tree)
    : lists_(std::move(lists)),
      neighbours_(std::move(neighbours)),
      tree_(std::move(tree)),
      mesh_(&mesh),
      horizon_(horizon) {
  for (std::size_t level = 1; level <= coarsest(); ++level)
    node_lists_.push_back(lists_of_nodes(tree_.node_of[level], lists_));
}

std::vector<std::uint32_t> StreamStore::wanted_in(std::uint32_t cell, std::size_t level) const {
  std::set<std::uint32_t> reached{cell};
  std::vector<std::uint32_t> rim{cell};
  for (int step = 0; step < horizon_ && !rim.empty(); ++step) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t c : rim) {
      for (const std::uint32_t n : neighbours_[c]) {
        if (reached.insert(n).second) next.push_back(n);
      }
    }
    rim = std::move(next);
  }
  const auto& lists = level == 0 ? lists_ : node_lists_[level - 1];
  if (level > 0) {
    std::set<std::uint32_t> nodes;
    for (const std::uint32_t c : reached) nodes.insert(tree_.node_of[level][c]);
    reached = std::move(nodes);
  }
  std::vector<std::uint32_t> wanted;
  for (const std::uint32_t c : reached) wanted.insert(wanted.end(), lists[c].begin(), lists[c].end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}

void StreamStore::add_contours() {
  const EdgeUsers edges(*mesh_);
  ListFloods floods(edges);
  contours_.clear();
  for (std::uint32_t cell = 0; cell < lists_.size(); ++cell)
    contours_.push_back(client_contour(edges, floods, cell, wanted_in(cell, coarsest()), lists_[cell]));
}

std::uint32_t StreamStore::coarsest_node(std::uint32_t cell) const {
  return coarsest() == 0 ? cell : tree_.node_of[coarsest()][cell];
}

std::vector<scene::CellContour> StreamStore::contours_of_node(std::uint32_t node) const {
  std::vector<scene::CellContour> out;
  for (const auto& contour : contours_) {
    if (coarsest_node(contour.cell) == node) out.push_back(contour);
  }
  return out;
}

std::string StreamStore::digest() const {
  std::string text = "horizon " + std::to_string(horizon_) + "\n";
  if (!contours_.empty()) text += "contours\n";
  const auto add = [&text](const char* name, const std::vector<std::uint32_t>& row) {
    text += name;
    for (const std::uint32_t x : row) text.append(" ").append(std::to_string(x));
    text += "\n";
  };
  for (const auto& row : lists_) add("list", row);
  for (const auto& row : neighbours_) add("neighbours", row);
  for (std::size_t level = 1; level <= coarsest(); ++level) add("nodes", tree_.node_of[level]);
  return scene::sha256_of(text);
}

std::vector<StreamMessage> StreamServer::enter(std::uint32_t cell, std::size_t level) {
  const DeltaPackets at_once = packets_of(mirror_.triangles(), store_->seen_from(cell));
  std::vector<StreamMessage> messages;
  if (!at_once.plus.empty()) messages.push_back(mirror_.plus(at_once.plus));
  StreamMessage entered;
  entered.cell = cell;
  messages.push_back(entered);
  const auto gone = packets_of(mirror_.triangles(), store_->wanted_in(cell, store_->coarsest())).minus;
  if (!gone.empty()) messages.push_back(mirror_.minus(gone));
  const auto later = packets_of(mirror_.triangles(), store_->wanted_in(cell, level)).plus;
  if (!later.empty()) messages.push_back(mirror_.plus(later));
  const std::uint32_t node = store_->coarsest_node(cell);
  if (node_ != node) {
    node_ = node;
    StreamMessage drawn;
    drawn.kind = StreamMessage::Kind::contours;
    drawn.contours = store_->contours_of_node(node);
    if (!drawn.contours.empty()) messages.push_back(std::move(drawn));
  }
  messages_ += messages.size();
  return messages;
}

std::vector<StreamMessage> StreamServer::resume(const std::vector<std::uint32_t>& route, std::uint64_t have,
                                                const std::vector<std::size_t>& levels) {
  restart();
  std::vector<StreamMessage> tail;
  for (std::size_t i = 0; i < route.size(); ++i) {
    std::uint64_t number = messages_;
    for (StreamMessage& message : enter(route[i], levels.empty() ? store_->coarsest() : levels[i])) {
      if (number++ >= have) tail.push_back(std::move(message));
    }
  }
  require_said(have);
  return tail;
}

void StreamServer::restart() {
  mirror_ = DisplayList(store_->mesh());
  node_.reset();
  messages_ = 0;
}

void StreamServer::require_said(std::uint64_t have) const {
  if (have <= messages_) return;
  throw scene::Error(scene::ErrorCode::bad_argument, "resume: this route has " + std::to_string(messages_) +
                                                         " messages, and the client has more; begin anew");
}

}  // namespace clues::reference

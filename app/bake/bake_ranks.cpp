#include "app/bake/bake_ranks.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>

#include "scene/bakes/packed_list.h"
#include "scene/messages/error.h"
#include "validate/processes/dispatcher.h"
#include "validate/processes/thread_pool.h"

namespace clues::app {
namespace {

using fastpath::bakes::BakePiece;
using fastpath::bakes::BakeProgress;
using fastpath::bakes::ListerMaker;
using fastpath::bakes::PieceBaker;
using fastpath::bakes::pieces_of;
using scene::PlaceKind;
using Done = std::vector<scene::BakeStore::Done>;

constexpr std::chrono::milliseconds look_up{200};
constexpr std::size_t most_in_one = 256;  // places of one transaction

// Ranks are machines of one kind.
struct PlaceHead {
  std::uint64_t kind, index, bytes;
  std::int64_t fallbacks, mapped, passes;
};

std::string text_of(const Done& done, std::uint32_t triangles) {
  std::string text;
  for (const auto& [kind, index, place] : done) {
    const std::string list = scene::packed_list(place.list, triangles);
    const PlaceHead head{
        kind == PlaceKind::cell ? 1U : 0U, index, list.size(), place.fallbacks, place.mapped, place.passes};
    text.append(reinterpret_cast<const char*>(&head), sizeof head);
    text += list;
  }
  return text;
}

scene::Error cut_off() {
  return {scene::ErrorCode::internal, "what a rank sent is cut off; do all ranks run the same program?"};
}

Done done_of(const std::string& text, std::uint32_t triangles) {
  Done done;
  for (std::size_t at = 0; at < text.size();) {
    PlaceHead head{};
    if (text.size() - at < sizeof head) throw cut_off();
    std::memcpy(&head, text.data() + at, sizeof head);
    at += sizeof head;
    if (text.size() - at < head.bytes) throw cut_off();
    done.push_back({head.kind == 1 ? PlaceKind::cell : PlaceKind::node,
                    static_cast<std::uint32_t>(head.index),
                    {scene::unpacked_list(text.substr(at, head.bytes), triangles, "a rank"), head.fallbacks,
                     head.mapped, head.passes}});
    at += head.bytes;
  }
  return done;
}

// What works on pieces here: of each, what is known must be told before it is begun.
class PieceWork {
 public:
  PieceWork(const scene::FlaggedMesh& scene, const scene::BakePlan& plan, const ListerMaker& make_lister)
      : triangles_(plan.triangles), pieces_(pieces_of(plan)), baker_(scene, plan, make_lister) {}

  const std::vector<BakePiece>& pieces() const { return pieces_; }

  void learn(std::uint64_t piece, const std::string& known) {
    const std::lock_guard lock(mutex_);
    known_[piece] = known;
  }

  std::string map(std::uint64_t piece) {
    std::string known;
    {
      const std::lock_guard lock(mutex_);
      known = std::move(known_.extract(piece).mapped());
    }
    return text_of(baker_.map(pieces_.at(piece), done_of(known, triangles_)), triangles_);
  }

 private:
  const std::uint32_t triangles_;
  const std::vector<BakePiece> pieces_;
  const PieceBaker baker_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::string> known_;
};

}  // namespace

std::string question_to_ranks(const scene::BakePlan& plan) { return plan.scene_sha256 + plan.question; }

void bake_by_ranks(Cluster& cluster, int threads, const scene::FlaggedMesh& scene, const scene::BakePlan& plan,
                   scene::BakeStore& store, const ListerMaker& make_lister, Shard shard, const std::atomic<bool>& stop,
                   const BakeProgress& progress) {
  PieceWork work(scene, plan, make_lister);
  std::vector<std::uint64_t> open;
  std::vector<double> expected;
  std::uint64_t cells = 0;
  for (std::uint64_t i = 0; i < work.pieces().size(); ++i) {
    const auto& piece = work.pieces()[i];
    const auto left = std::count_if(piece.cells.begin(), piece.cells.end(),
                                    [&](std::uint32_t c) { return !store.has(PlaceKind::cell, c); });
    cells += piece.cells.size() - static_cast<std::size_t>(left);
    if (left == 0 || piece.index % shard.count != shard.index) continue;
    open.push_back(i);
    expected.push_back(static_cast<double>(left));
  }
  if (open.empty()) return;
  const auto known = [&](std::uint64_t i) {
    Done done;
    const auto take = [&](PlaceKind kind, const std::vector<std::uint32_t>& places) {
      for (const auto p : places) {
        if (auto place = store.find(kind, p)) done.push_back({kind, p, std::move(*place)});
      }
    };
    take(PlaceKind::node, work.pieces()[i].nodes);
    take(PlaceKind::cell, work.pieces()[i].cells);
    return text_of(done, plan.triangles);
  };
  const auto own = [&](std::uint64_t piece) { return work.map(piece); };
  const auto pool = cluster.pool(question_to_ranks(plan), std::make_unique<validate::ThreadPool>(threads, own), threads,
                                 known, [&](std::uint64_t piece, const std::string& text) { work.learn(piece, text); });
  const auto order = validate::longest_first(expected);
  std::size_t next = 0;
  const auto hand_out = [&] {
    while (pool->idle() && next < order.size() && !stop) pool->start(open[order[next++]]);
  };
  for (hand_out(); !pool->empty(); hand_out()) {
    // One transaction for all that came meanwhile; who has sent something works on before it is written.
    Done batch;
    for (auto reply = pool->wait(look_up); reply; reply = batch.size() < most_in_one ? pool->wait({}) : std::nullopt) {
      if (!reply->finished) throw scene::Error(scene::ErrorCode::internal, "a cell: " + reply->text);
      for (auto& done : done_of(reply->text, plan.triangles)) batch.push_back(std::move(done));
      hand_out();
    }
    if (batch.empty()) continue;
    store.commit(batch);
    cells += static_cast<std::uint64_t>(
        std::count_if(batch.begin(), batch.end(), [](const auto& d) { return d.kind == PlaceKind::cell; }));
    progress(cells);
  }
}

void serve_bake(Cluster& cluster, int threads, const scene::FlaggedMesh& scene, const scene::BakePlan& plan,
                const ListerMaker& make_lister, const std::string& question) {
  if (question != question_to_ranks(plan))
    throw scene::Error(scene::ErrorCode::bad_argument,
                       plan.scene_file + ": is another scene, or asked about otherwise, than on the first rank");
  PieceWork work(scene, plan, make_lister);
  validate::ThreadPool own(threads, [&](std::uint64_t piece) { return work.map(piece); });
  cluster.serve(own, threads, [&](std::uint64_t piece, const std::string& known) { work.learn(piece, known); });
}

}  // namespace clues::app

// Any-hit segment queries of one thread (D5), side by side in one process: our tree, whose every answer is exactly right, Embree 3 (single
// precision; only if it was found at configure time) and CGAL's AABB tree. Medians of interleaved rounds; wrong answers are counted.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fastpath/queries/bvh.h"
#include "fastpath/queries/segment_queries.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random.h"
#include "segment_peers.h"

namespace {

using clues::fastpath::Bvh;
using clues::fastpath::Segment;
using clues::fastpath::SegmentQueries;
using clues::fuzz::Random;
using clues::scene::Point;
using clues::scene::TriangleMesh;
namespace peers = clues::bench;

constexpr std::uint64_t kSeed = 1;
constexpr int kRounds = 7;
constexpr std::size_t kSegments = 100000;

double uniform(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }
double as_float(double x) { return static_cast<double>(static_cast<float>(x)); }

// Bumps on the unit square; all coordinates are floats, so that a peer in single precision is given the same input.
TriangleMesh height_field(std::uint32_t n) {
  Random random(kSeed);
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = (i + 0.3 * (uniform(random) - 0.5)) / n, y = (j + 0.3 * (uniform(random) - 0.5)) / n;
      const double z =
          0.05 * std::sin(17 * x) * std::cos(13 * y) + 0.02 * std::sin(71 * x + 5 * y) + 0.2 / n * uniform(random);
      mesh.points.push_back({as_float(x), as_float(y), as_float(z)});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = j * (n + 1) + i, q = p + n + 1;
      mesh.triangles.push_back({p, p + 1, q + 1});
      mesh.triangles.push_back({p, q + 1, q});
    }
  }
  return mesh;
}

// Between points of the scene's box, made twice as high so that hits and misses are both common.
std::vector<Segment> random_segments(const TriangleMesh& mesh, std::size_t n) {
  Point low = mesh.points[0], high = low;
  for (const Point& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  high[2] += high[2] - low[2];
  Random random(kSeed + 1);
  std::vector<Segment> out(n);
  for (Segment& s : out) {
    for (std::size_t k = 0; k < 3; ++k) {
      s.a[k] = as_float(low[k] + (high[k] - low[k]) * uniform(random));
      s.b[k] = as_float(low[k] + (high[k] - low[k]) * uniform(random));
    }
  }
  return out;
}

// Through corners and edges of triangles, rounded to floats: what floats decide by luck. Short, so that what is aimed at decides.
std::vector<Segment> near_degenerate_segments(const TriangleMesh& mesh, double reach, std::size_t n) {
  Random random(kSeed + 2);
  std::vector<Segment> out(n);
  for (Segment& s : out) {
    const auto& t = mesh.triangles[random.next() % mesh.triangles.size()];
    const Point &p = mesh.points[t[0]], &q = mesh.points[t[1]];
    const double along = random.one_in(2) ? 0 : uniform(random);
    for (std::size_t k = 0; k < 3; ++k) {
      const double target = p[k] + along * (q[k] - p[k]);
      s.a[k] = as_float(target + reach * (uniform(random) - 0.5));
      s.b[k] = as_float(2 * target - s.a[k]);
    }
  }
  return out;
}

struct Peer {
  std::string name;
  std::function<void(const std::vector<Segment>&, std::vector<std::uint8_t>&)> run;
  std::vector<double> rates{};
  std::vector<std::uint8_t> answers{};
};

template <class AnyHit>
Peer one_by_one(const std::string& name, AnyHit any_hit) {
  return {name, [any_hit](const std::vector<Segment>& segments, std::vector<std::uint8_t>& answers) {
            for (std::size_t i = 0; i < segments.size(); ++i) answers[i] = any_hit(segments[i]) ? 1 : 0;
          }};
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

void run_rounds(std::vector<Peer>& peer_list, const std::vector<Segment>& segments) {
  for (Peer& peer : peer_list) {
    peer.answers.assign(segments.size(), 0);
    peer.rates.clear();
  }
  for (int round = 0; round < kRounds; ++round) {
    for (Peer& peer : peer_list) {
      const auto start = std::chrono::steady_clock::now();
      peer.run(segments, peer.answers);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      peer.rates.push_back(static_cast<double>(segments.size()) / seconds);
    }
  }
}

void report(const std::string& scene, const std::string& kind, const std::vector<Peer>& peer_list) {
  const Peer& ours = peer_list.front();
  for (const Peer& peer : peer_list) {
    std::size_t hits = 0, differ = 0;
    for (std::size_t i = 0; i < peer.answers.size(); ++i) {
      hits += peer.answers[i];
      differ += peer.answers[i] != ours.answers[i] ? 1 : 0;
    }
    std::vector<double> ratios;
    for (std::size_t i = 0; i < peer.rates.size(); ++i) ratios.push_back(ours.rates[i] / peer.rates[i]);
    fmt::print("{:<14} {:<15} {:<24} {:>11.0f} {:>10.2f} {:>8.1f} {:>9}/{}\n", scene, kind, peer.name,
               median(peer.rates), median(ratios),
               100.0 * static_cast<double>(hits) / static_cast<double>(peer.answers.size()), differ,
               peer.answers.size());
  }
  std::fflush(stdout);
}

void bench(const std::string& name, const TriangleMesh& mesh, double reach) {
  const auto start = std::chrono::steady_clock::now();
  const Bvh bvh(mesh);
  const double build = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  SegmentQueries queries(bvh);
  std::vector<Peer> peer_list;
  peer_list.push_back(one_by_one("clues (exact)", [&](const Segment& s) { return queries.any_hit(s); }));
  peer_list.push_back(
      {"clues (exact), batch", [&](const std::vector<Segment>& segments, std::vector<std::uint8_t>& answers) {
         queries.any_hits(segments, answers);
       }});
  std::string builds = fmt::format("clues {:.2f} s", build);
  std::vector<peers::NamedPeer> others = peers::make_peers(mesh);
  for (peers::NamedPeer& other : others) {
    peer_list.push_back(one_by_one(other.name, other.any_hit));
    builds += fmt::format(", {} {:.2f} s", other.name, other.build_seconds);
  }
  fmt::print("# {}: {} triangles; built in: {}\n", name, mesh.triangles.size(), builds);

  for (const bool hard : {false, true}) {
    const auto segments = hard ? near_degenerate_segments(mesh, reach, kSegments) : random_segments(mesh, kSegments);
    const auto before = queries.counts();
    run_rounds(peer_list, segments);
    report(name, hard ? "near-degenerate" : "random", peer_list);
    const auto after = queries.counts();
    const auto per_query = [&](std::uint64_t x, std::uint64_t y) {
      return static_cast<double>(x - y) / static_cast<double>(after.queries - before.queries);
    };
    fmt::print("# per query: {:.2f} blocks of four, {:.4f} triangles in doubles, {:.4f} in whole numbers\n",
               per_query(after.blocks, before.blocks), per_query(after.doubles, before.doubles),
               per_query(after.exact, before.exact));
  }
}

// Sight lines of a street cell: from its corners and points in it to points of triangles, which do not block themselves.
void sight_lines() {
  constexpr std::uint32_t kTriangles = 10000;
  const TriangleMesh city = clues::fuzz::make_city(kTriangles, kSeed);
  const auto corners = clues::fuzz::street_cell(kTriangles, kSeed);
  const Bvh bvh(city);
  const clues::fastpath::Cell cell(corners);
  SegmentQueries queries(bvh);
  Random random(kSeed);
  std::vector<Segment> segments;
  std::vector<std::uint32_t> targets;
  for (int i = 0; i < 300000; ++i) {
    const auto t = static_cast<std::uint32_t>(random.next() % city.triangles.size());
    const auto& c = city.triangles[t];
    const double u = uniform(random), v = (1 - u) * uniform(random), x = uniform(random), y = uniform(random),
                 z = uniform(random);
    Segment s;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = k == 0 ? x : k == 1 ? y : z;
      s.a[k] = corners[0][k] + w * (corners[7][k] - corners[0][k]);
      s.b[k] = city.points[c[0]][k] * (1 - u - v) + city.points[c[1]][k] * u + city.points[c[2]][k] * v;
    }
    segments.push_back(s);
    targets.push_back(t);
  }
  for (const bool with_cell : {false, true}) {
    std::vector<double> rates;
    std::size_t free_lines = 0;
    for (int round = 0; round < kRounds; ++round) {
      free_lines = 0;
      const auto start = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < segments.size(); ++i) {
        free_lines += queries.any_hit(segments[i], {{&targets[i], 1}, with_cell ? &cell : nullptr}) ? 0 : 1;
      }
      rates.push_back(static_cast<double>(segments.size()) /
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    fmt::print("# sight lines of a street cell, city of {} triangles{}: {:.0f} per second, {:.1f} % free\n",
               city.triangles.size(), with_cell ? ", the inside of the cell left out (D3)" : "", median(rates),
               100.0 * static_cast<double>(free_lines) / static_cast<double>(segments.size()));
  }
}

}  // namespace

int main() {
  fmt::print(
      "# any-hit segment queries, one thread, medians of {} interleaved rounds; ours/peer: how many times our rate is "
      "the peer's;\n"
      "# differ: answers unlike ours, which are exact\n",
      kRounds);
  if (!peers::kHaveEmbree) fmt::print("# Embree was not found at configure time (libembree-dev): left out\n");
  fmt::print("{:<14} {:<15} {:<24} {:>11} {:>10} {:>8} {:>9}\n", "scene", "segments", "peer", "queries/s", "ours/peer",
             "% hit", "differ");
  sight_lines();
  bench("city 10k", clues::fuzz::make_city(10000, kSeed), 4);
  bench("bumps 100k", height_field(224), 0.01);
  bench("bumps 1M", height_field(708), 0.01);
}

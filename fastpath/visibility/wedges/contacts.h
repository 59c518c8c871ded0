// The contour vertices of one map (D12): mesh vertices, and CSVs, where a valid wedge piece meets an edge. Each has a local picture, its Apex, and
// the probes that have lit it in the current round; those say which of its sectors are wedges.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fastpath/visibility/wedges/apex.h"
#include "fastpath/visibility/wedges/contour.h"
#include "fastpath/visibility/wedges/lit_sectors.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

struct Contact {
  const ExactPoint* x = nullptr;
  bool on_edge = false;
  std::uint32_t id = 0;                          // of the edge that x is a point of, or of the mesh vertex
  int generation = 0;                            // of its wedges; -1: a CSV not met in this round
  std::unique_ptr<Apex> apex;                    // made when the contact is lit
  std::unique_ptr<LitSectors> lit;               // made when it is asked for
  bool has_all_sectors = false;                  // once lit: too intricate to tell which
  std::vector<Probe> probes;                     // of this round
  bool fresh = false;                            // some of them came since the last Contacts::lit()
  std::vector<bool> built;                       // by sector: in this round
  std::vector<std::unique_ptr<OnWedge>> wedges;  // by sector, once made
  std::vector<std::uint32_t> sectors;            // that exist given the probes, once found
};

class Contacts {
 public:
  Contacts(const LocalScene& scene, const std::vector<ContourEdge>& contours, Workers& workers);

  // The apex of a mesh vertex, made if need be. Different vertices may be asked for by different threads.
  const Apex& apex_of(std::uint32_t vertex, Pool& pool);
  Contact* corner(std::uint32_t vertex);
  // Edges and points of them, which stay where they are and belong to one edge only.
  void make_csvs(const std::vector<std::pair<std::uint32_t, const ExactPoint*>>& points);
  // At such a point.
  Contact* csv(const ExactPoint* x) const { return csv_at_.at(x); }
  // All of them: corners, then CSVs by edge.
  template <class Work>
  void for_all(const Work& work) const {
    for (const auto& c : corners_) {
      if (c) work(*c);
    }
    for (const auto& list : on_edge_) {
      for (const auto& c : list) work(*c);
    }
  }

  // None is left. With all threads.
  void clear();

  void start_round();
  void add(Contact* contact, const Probe& probe);
  // Contacts that have got probes since the last call, in this order, but those without sectors.
  std::vector<Contact*> lit();
  // Those that exist given the probes of these contacts.
  void find_sectors(const std::vector<Contact*>& contacts);

  // Vertices too intricate to decide, which have all their sectors.
  std::uint64_t conservative_fallbacks() const { return fallbacks_; }

 private:
  std::unique_ptr<Contact> make(bool on_edge, std::uint32_t id, const ExactPoint* x) const;
  void make_apex(Contact& contact, Pool& pool) const;

  const LocalScene& scene_;
  std::vector<std::vector<const Plane*>> contour_planes_;  // by vertex: of contour edges there
  Workers& workers_;
  std::vector<std::unique_ptr<Contact>> corners_;
  std::vector<std::vector<std::unique_ptr<Contact>>> on_edge_;
  std::unordered_map<const ExactPoint*, Contact*> csv_at_;
  std::vector<Contact*> touched_;
  std::atomic<std::uint64_t> fallbacks_{0};
};

}  // namespace clues::fastpath

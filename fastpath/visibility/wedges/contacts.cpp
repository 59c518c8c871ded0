#include "fastpath/visibility/wedges/contacts.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "scene/messages/error.h"

namespace clues::fastpath {

Contacts::Contacts(const LocalScene& scene, const std::vector<ContourEdge>& contours, Workers& workers)
    : scene_(scene),
      contour_planes_(scene.points.size()),
      workers_(workers),
      corners_(scene.points.size()),
      on_edge_(scene.edges.size()) {
  for (const ContourEdge& c : contours) {
    if (c.holds_cell) continue;
    for (const std::uint32_t end : {scene.edges[c.edge].a, scene.edges[c.edge].b})
      contour_planes_[end].push_back(c.plane);
  }
}

std::unique_ptr<Contact> Contacts::make(bool on_edge, std::uint32_t id, const ExactPoint* x) const {
  auto c = std::make_unique<Contact>();
  c->x = x;
  c->on_edge = on_edge;
  c->id = id;
  return c;
}

void Contacts::make_apex(Contact& c, Pool& pool) const {
  if (c.apex) return;
  c.apex = std::make_unique<Apex>(scene_, pool, c.on_edge, c.id, c.x);
  c.built.assign(c.apex->sectors().size(), false);
  c.wedges.resize(c.apex->sectors().size());
}

const Apex& Contacts::apex_of(std::uint32_t vertex, Pool& pool) {
  Contact* c = corner(vertex);
  make_apex(*c, pool);
  return *c->apex;
}

Contact* Contacts::corner(std::uint32_t vertex) {
  if (!corners_[vertex]) corners_[vertex] = make(false, vertex, &scene_.points[vertex]);
  return corners_[vertex].get();
}

void Contacts::make_csvs(const std::vector<std::pair<std::uint32_t, const ExactPoint*>>& points) {
  struct Asked {
    const ExactPoint* x = nullptr;
    Contact** contact = nullptr;
  };
  std::map<std::uint32_t, std::vector<Asked>> by_edge;
  for (const auto& [edge, x] : points) {
    const auto [at, is_new] = csv_at_.try_emplace(x, nullptr);
    if (is_new) by_edge[edge].push_back({x, &at->second});
  }
  std::vector<std::uint32_t> edges;
  for (const auto& [edge, list] : by_edge) edges.push_back(edge);
  workers_.for_each(edges.size(), [&](std::size_t i, Workers::Worker&) {
    auto& contacts = on_edge_[edges[i]];
    for (const Asked& asked : by_edge.at(edges[i])) {
      const auto known =
          std::find_if(contacts.begin(), contacts.end(), [&](const auto& c) { return equal(*c->x, *asked.x); });
      if (known != contacts.end()) {
        *asked.contact = known->get();
        continue;
      }
      *asked.contact = contacts.emplace_back(make(true, edges[i], asked.x)).get();
      (*asked.contact)->generation = -1;
    }
  });
}

void Contacts::clear() {
  csv_at_.clear();
  touched_.clear();
  workers_.for_each(corners_.size(), [this](std::size_t i, Workers::Worker&) { corners_[i].reset(); });
  workers_.for_each(on_edge_.size(), [this](std::size_t i, Workers::Worker&) { on_edge_[i].clear(); });
}

void Contacts::start_round() {
  for_all([](Contact& c) {
    c.probes.clear();
    c.fresh = false;
    std::fill(c.built.begin(), c.built.end(), false);
    if (c.on_edge) c.generation = -1;
  });
}

void Contacts::add(Contact* c, const Probe& probe) {
  if (std::find(c->probes.begin(), c->probes.end(), probe) != c->probes.end()) return;
  c->probes.push_back(probe);
  if (!c->fresh) touched_.push_back(c);
  c->fresh = true;
}

std::vector<Contact*> Contacts::lit() {
  std::vector<Contact*> contacts;
  contacts.swap(touched_);
  workers_.for_each(contacts.size(),
                    [&](std::size_t i, Workers::Worker& worker) { make_apex(*contacts[i], worker.pool); });
  for (Contact* c : contacts) c->fresh = false;
  std::erase_if(contacts, [](const Contact* c) { return c->apex->sectors().empty(); });
  return contacts;
}

void Contacts::find_sectors(const std::vector<Contact*>& contacts) {
  static const std::vector<const Plane*> none;
  workers_.for_each(contacts.size(), [&](std::size_t i, Workers::Worker&) {
    Contact& c = *contacts[i];
    // A sector too many only makes more visible: where the vertex is too intricate to decide, all of them.
    std::vector<std::uint32_t> sectors(c.apex->sectors().size());
    std::iota(sectors.begin(), sectors.end(), 0U);
    try {
      if (!c.has_all_sectors) {
        if (!c.lit) c.lit = std::make_unique<LitSectors>(scene_, *c.apex, c.on_edge ? none : contour_planes_[c.id]);
        sectors = c.lit->existing(c.probes);
      }
    } catch (const scene::Error& error) {
      if (error.code() != scene::ErrorCode::internal) throw;
      c.has_all_sectors = true;
      ++fallbacks_;
    }
    c.sectors = std::move(sectors);
  });
}

}  // namespace clues::fastpath

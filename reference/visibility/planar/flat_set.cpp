#include "reference/visibility/planar/flat_set.h"

#include <CGAL/Arr_default_overlay_traits.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_overlay_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include <array>
#include <map>
#include <set>
#include <utility>

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point2;

namespace {

using Traits = CGAL::Arr_segment_traits_2<Kernel>;
using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, unsigned>>;  // 0: not in the set
using Curve = Traits::X_monotone_curve_2;

// Of what is in none of two sets, in the one, in the other, in both: the label in their overlay. A table and no function of its own for each use, so that there is one
// overlay to be compiled.
using Rule = std::array<unsigned, 4>;

class RuledFaces : public CGAL::Arr_default_overlay_traits<Arrangement> {
 public:
  explicit RuledFaces(const Rule& rule) : rule_(rule) {}
  void create_face(Face_handle_A one, Face_handle_B other, Face_handle_R made) const override {
    made->set_data(rule_[(one->data() != 0 ? 1U : 0U) + (other->data() != 0 ? 2U : 0U)]);
  }

 private:
  Rule rule_;
};

void overlay(const Arrangement& one, const Arrangement& other, const Rule& rule, Arrangement& made) {
  RuledFaces traits(rule);
  CGAL::overlay(one, other, made, traits);
}

// Takes away borders with the same label on both sides, and corners in the middle of straight borders.
void tidy(Arrangement& arrangement) {
  std::vector<Arrangement::Halfedge_handle> seams;
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    if (e->face()->data() == e->twin()->face()->data()) seams.push_back(e);
  }
  for (const auto& e : seams) arrangement.remove_edge(e);
  std::vector<Arrangement::Vertex_handle> middles;
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
    CGAL::exact(v->point());  // frees the history of the number
    if (v->degree() == 2) middles.push_back(v);
  }
  const auto* traits = arrangement.geometry_traits();
  for (const auto& v : middles) {
    const Arrangement::Halfedge_handle in = v->incident_halfedges(), out = in->next();
    if (!traits->are_mergeable_2_object()(in->curve(), out->curve())) continue;
    Curve merged;
    traits->merge_2_object()(in->curve(), out->curve(), merged);
    arrangement.merge_edge(in, out, merged);
  }
}

Face2 rings_of(const Arrangement::Face_const_handle& face) {
  Face2 rings;
  const auto add = [&rings](Arrangement::Ccb_halfedge_const_circulator start) {
    rings.emplace_back();
    auto h = start;
    do {
      rings.back().push_back(h->source()->point());
    } while (++h != start);
  };
  add(face->outer_ccb());
  for (auto hole = face->inner_ccbs_begin(); hole != face->inner_ccbs_end(); ++hole) add(*hole);
  return rings;
}

}  // namespace

struct FlatSet::Faces {
  Arrangement arrangement;
};

void FlatSet::take(std::shared_ptr<Faces> faces) {
  tidy(faces->arrangement);
  faces_.reset();
  area_ = FT(0);
  if (faces->arrangement.number_of_edges() == 0) return;
  faces_ = std::move(faces);
  for (const Face2& face : this->faces()) {
    for (const Ring2& ring : face) area_ += twice_area(ring);  // holes run clockwise
  }
  area_ = exact::collapsed(area_);
}

FlatSet::FlatSet(const FT& twice_triangle, const std::vector<Face2>& faces) : FlatSet(twice_triangle) {
  if (faces.empty()) return;
  using Step = std::pair<Point2, Point2>;
  std::set<Step> borders;
  for (const Face2& face : faces) {
    for (const Ring2& ring : face) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        borders.insert(a < b ? Step(a, b) : Step(b, a));
      }
    }
  }
  auto made = std::make_shared<Faces>();
  Arrangement& arrangement = made->arrangement;
  std::vector<Curve> curves;
  for (const auto& [a, b] : borders) curves.emplace_back(a, b);
  CGAL::insert_non_intersecting_curves(arrangement, curves.begin(), curves.end());
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) f->set_data(0);
  std::map<Step, Arrangement::Halfedge_handle> steps;
  for (auto h = arrangement.halfedges_begin(); h != arrangement.halfedges_end(); ++h)
    steps.emplace(Step(h->source()->point(), h->target()->point()), h);
  for (const Face2& face : faces) steps.at(Step(face[0][0], face[0][1]))->face()->set_data(1);
  take(std::move(made));
}

std::vector<Face2> FlatSet::faces() const {
  std::vector<Face2> out;
  if (!faces_) return out;
  const Arrangement& arrangement = faces_->arrangement;
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    if (f->data() != 0) out.push_back(rings_of(f));
  }
  return out;
}

FlatSet FlatSet::combine(const FlatSet& a, const FlatSet& b, const std::array<unsigned, 4>& rule) {
  auto made = std::make_shared<Faces>();
  overlay(a.faces_->arrangement, b.faces_->arrangement, rule, made->arrangement);
  FlatSet result(a.triangle_);
  result.take(std::move(made));
  return result;
}

std::vector<Face2> FlatSet::faces_cut_by(const std::vector<FlatSegment>& segments) const {
  if (!faces_ || segments.empty()) return faces();
  Arrangement cuts, cut;
  std::vector<Curve> curves;
  for (const FlatSegment& s : segments) curves.emplace_back(s.a, s.b);
  CGAL::insert(cuts, curves.begin(), curves.end());
  for (auto f = cuts.faces_begin(); f != cuts.faces_end(); ++f) f->set_data(0);
  overlay(faces_->arrangement, cuts, {0, 1, 0, 1}, cut);
  std::vector<Face2> out;
  for (auto f = cut.faces_begin(); f != cut.faces_end(); ++f) {
    if (f->data() != 0) out.push_back(rings_of(f));
  }
  return out;
}

std::vector<FlatSegment> FlatSet::borders_of(const FlatSet& part) const {
  std::vector<FlatSegment> out;
  if (!faces_ || !part.faces_) return out;
  Arrangement both;
  overlay(faces_->arrangement, part.faces_->arrangement, {0, 1, 2, 3}, both);
  for (auto e = both.edges_begin(); e != both.edges_end(); ++e) {
    const unsigned one = e->face()->data(), other = e->twin()->face()->data();
    if ((one & other & 1U) != 0 && one != other) out.push_back({e->source()->point(), e->target()->point()});
  }
  return out;
}

FlatSet unite(const FlatSet& a, const FlatSet& b) {
  if (a.empty() || b.whole()) return b;
  if (b.empty() || a.whole()) return a;
  return FlatSet::combine(a, b, {0, 1, 1, 1});
}

FlatSet intersect(const FlatSet& a, const FlatSet& b) {
  if (a.empty() || b.whole()) return a;
  if (b.empty() || a.whole()) return b;
  return FlatSet::combine(a, b, {0, 0, 0, 1});
}

FlatSet subtract(const FlatSet& a, const FlatSet& b) {
  if (a.empty() || b.empty()) return a;
  if (b.whole()) return FlatSet(a.triangle_);
  return FlatSet::combine(a, b, {0, 1, 0, 0});
}

}  // namespace clues::reference

#include "fastpath/visibility/wedges/lit_sectors.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fastpath/visibility/wedges/circle_star.h"

namespace clues::fastpath {

namespace {

using Face = std::vector<int>;

// What intervals may fail to make: that is tried once.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  T& get(const Make& make) {
    if (failed_) throw Unsure{};
    if (made_) return *made_;
    try {
      return made_.emplace(make());
    } catch (const Unsure&) {
      failed_ = true;
      throw;
    }
  }

 private:
  std::optional<T> made_;
  bool failed_ = false;
};

// What is around x in one number type, and where probes and sectors are in it. Made when it is asked for.
template <class NT>
class Picture {
 public:
  using V = Vec3<NT>;
  struct Lit {
    Beside<NT> beside;
    Face face;
  };
  struct Inside {
    V inner;  // beside the middle of a sector, in A(x)
    Face face;
  };

  Picture(const LocalScene& scene, const Apex& apex) : star(apex.star<NT>()), insides_(apex.sectors().size()) {
    for (const ExactPoint& s : scene.cell.vertices) anticone.push_back(direction<NT>(s, *apex.x()));
    away_ = anticone.front();
    for (std::size_t i = 1; i < anticone.size(); ++i) away_ = away_ + anticone[i];
  }

  const Lit& lit(std::size_t number, const Probe& p) {
    if (lit_.size() <= number) lit_.resize(number + 1);
    return lit_[number].get([&] {
      Lit l{{star.to(*p.to), nothing_, nothing_, p.at}, {}};
      if (p.plane) {
        const V n = normal_direction<NT>(*p.plane);
        l.beside.aside = n;
        l.beside.off = n;
        if (p.kind == Probe::Kind::csv) {
          const V ccw = cross(n, -l.beside.limit);
          l.beside.aside = p.aside > 0 ? ccw : -ccw;
        }
      }
      l.face = star.face_of(p.plane ? star.moved(l.beside) : l.beside.limit);
      return l;
    });
  }
  V middle(const ApexSector& s) const { return balanced_sum<NT>(star.to(*s.ray0), star.to(*s.ray1)); }
  const Inside& inside(std::size_t number, const ApexSector& s) {
    return insides_[number].get([&] {
      const V n = normal_direction<NT>(*s.plane);
      const V inner = star.moved({middle(s), sign_of(NT(dot(n, away_))) > 0 ? away_ : n, nothing_, {}});
      return Inside{inner, star.face_of(inner)};
    });
  }

  Star<NT> star;
  std::vector<V> anticone;

 private:
  V nothing_{NT(0), NT(0), NT(0)}, away_;
  std::vector<MadeOnce<Lit>> lit_;
  std::vector<MadeOnce<Inside>> insides_;
};

// At a mesh vertex: the circle of a plane with V on one side, of a contour edge or a sector. What follows is made when it is first asked for.
struct Circle {
  const Plane* plane;
  std::optional<Vec3<Integer>> normal;
  bool divides = false;  // faces
  std::optional<CircleStar> star;
  std::vector<std::pair<Face, Face>> across;
  std::vector<Face> inside;  // of sectors
};

enum class Answer : std::uint8_t { unknown, no, yes, unsure };

Answer answer(bool yes) { return yes ? Answer::yes : Answer::no; }

}  // namespace

class LitSectors::Work {
 public:
  Work(const LocalScene& scene, const Apex& apex, const std::vector<const Plane*>& contours)
      : scene_(&scene), apex_(&apex) {
    if (apex.on_edge() || apex.flat()) return;
    const auto add = [&](const Plane* plane) {
      if (circles_.empty() || circles_.back().plane != plane) circles_.push_back({plane, {}, false, {}, {}, {}});
    };
    for (const Plane* plane : contours) add(plane);
    for (const ApexSector& s : apex.sectors()) add(s.plane);
  }

  // A number for each probe.
  std::size_t number_of(const Probe& probe) {
    const auto known = std::find_if(seen_.begin(), seen_.end(), [&](const Seen& s) { return s.probe == probe; });
    if (known != seen_.end()) return static_cast<std::size_t>(known - seen_.begin());
    const std::vector<Answer> none(apex_->sectors().size(), Answer::unknown);
    seen_.push_back({probe, none, none, {}});
    return seen_.size() - 1;
  }
  std::vector<std::uint32_t> existing(const std::vector<std::size_t>& probes) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < apex_->sectors().size(); ++i) {
      if (apex_->flat() || exists(i, probes)) found.push_back(i);
    }
    return found;
  }

 private:
  // A sector that bounds nothing is left out. Let its plane have V on the side H+, and A(x) on the other; d
  // be the direction of visible space beside x, strictly in H+, from which the great circle arc to `middle`
  // meets no arc. Then
  // 1. The points just off the sector in H+, near x, are in Omega. From x + r d, r small, sight lines go on
  //    in the directions x + r d - v, v in int V, which are as near as one likes to those of A(x) (D8), so
  //    also to `middle` on the border of A(x), and reach points that project to the arc from d towards
  //    `middle`. With v near enough to where the plane touches V they stay in H+ until as near to the
  //    sector as one likes. What touches x is a cone beside x and meets no such arc if they are near enough
  //    to the one that was tested (arcs are closed); all else is farther away. From there in the same way
  //    to all directions of the sector: no arc crosses it (split()), and one that lies along it covers all
  //    of it, `middle` too, and then the test failed.
  // 2. So they are farther out, too: from x + r m, m just off the sector in H+, sight lines go on beside
  //    the plane to the first surface in H+ that touches it. Let y be a point of the valid piece beyond
  //    that, in general position, with x + t (x - v) = y for a v of the touching edge of V. All such v near
  //    by, and so all points x' of the plane near x, are behind the same: an edge e in the plane (a vertex
  //    hides a line only, in the limit). All triangles at e are in the closed H+, or the piece of x would
  //    end at e (D13); V touches the plane in v; and beside e, in H-, is Omega, for e is on the valid piece
  //    of x. So y is on the wedge of e in this plane (D10, D11), or on a sector in this plane at an end of
  //    a lit part of e, nearer to y than x is. If that sector is left out as well, the same holds of it;
  //    this ends, as there are finitely many edges. So where the two sides of the sector differ in label,
  //    another valid piece lies there.
  // 3. At a CSV the edge's end in H- of the piece that crosses it is such a d, if that is strictly in H+ of
  //    the sector: beside the edge towards that end, all that the face of the probe reaches by `spreads` is
  //    in Omega (the probe looks back along the piece, so sight lines go on from it towards x, that is, in
  //    the half plane of edge and probe as near to the edge as one likes; and `spreads` turns about the
  //    edge). So beside the edge, where `inner` is as seen along the edge, is Omega; and every arc is a
  //    half plane at the edge, so none is between there and `inner`.
  bool exists(std::size_t sector, const std::vector<std::size_t>& probes) {
    const auto any = [&](const auto& holds) { return std::any_of(probes.begin(), probes.end(), holds); };
    if (any([&](std::size_t p) { return lights_other_side(sector, p); })) return false;
    // A point of the visible part of a crossed edge reaches whatever its face allows.
    if (any([&](std::size_t p) {
          const Probe& probe = seen_[p].probe;
          return !probe.doubtful && probe.lit_end && plane(sector).side(*probe.lit_end) < 0 && reaches(sector, p);
        }))
      return false;
    return any([&](std::size_t p) { return reaches_by_intervals(sector, p) == Answer::yes; }) ||
           any([&](std::size_t p) { return reaches(sector, p); });
  }

  struct Seen {
    Probe probe;
    std::vector<Answer> on_other_side, reaches;  // by sector
    std::vector<Face> faces;                     // in the star with each circle
  };

  const ApexSector& sector_of(std::size_t sector) const { return apex_->sectors()[sector]; }
  const Plane& plane(std::size_t sector) const { return *sector_of(sector).plane; }
  template <class NT>
  Picture<NT>& around() {
    return std::get<MadeOnce<Picture<NT>>>(pictures_).get([&] { return Picture<NT>(*scene_, *apex_); });
  }

  // Visible space strictly in H+ that surely reaches the points just off the middle of the sector in H+.
  bool lights_other_side(std::size_t sector, std::size_t p) {
    Answer& known = seen_[p].on_other_side[sector];
    if (known == Answer::unknown) {
      const Probe& probe = seen_[p].probe;
      known = answer(!probe.doubtful && plane(sector).side(*probe.to) < 0 && decide<Integer>([&]<class NT>() {
        Picture<NT>& picture = around<NT>();
        return picture.star.free_between(picture.lit(p, probe).beside, picture.middle(sector_of(sector)));
      }));
    }
    return known == Answer::yes;
  }

  Answer reaches_by_intervals(std::size_t sector, std::size_t p) {
    Answer& known = seen_[p].reaches[sector];
    if (known != Answer::unknown) return known;
    try {
      known = answer(light_reaches<Interval>(sector, p));
    } catch (const Unsure&) {
      known = Answer::unsure;
    }
    return known;
  }
  bool reaches(std::size_t sector, std::size_t p) {
    if (reaches_by_intervals(sector, p) == Answer::unsure) {
      ++exact_decisions();
      seen_[p].reaches[sector] = answer(light_reaches<Integer>(sector, p));
    }
    return seen_[p].reaches[sector] == Answer::yes;
  }

  // Whether light gets from the probe to the inside of the sector.
  template <class NT>
  bool light_reaches(std::size_t sector, std::size_t p) {
    Picture<NT>& picture = around<NT>();
    const Star<NT>& star = picture.star;
    const auto& [inner, face] = picture.inside(sector, sector_of(sector));
    const auto& [from, its_face] = picture.lit(p, seen_[p].probe);
    if (its_face != face) return false;
    if (apex_->on_edge()) {
      const LocalEdge& e = scene_->edges[apex_->id()];
      const auto along = [&](std::size_t v) {
        return orientation(scene_->points[e.a], scene_->points[e.b], *seen_[p].probe.to, scene_->cell.vertices[v]) == 0;
      };
      return star.spreads(from, inner, picture.anticone, along);
    }
    if (star.free_between(from, inner)) return true;
    if constexpr (std::is_same_v<NT, Interval>) {
      if (gets_there_by_a_ray(star, from, inner, picture.anticone)) return true;
      throw Unsure{};  // circles meet arcs in points that intervals do not know to be on both
    } else {
      return passes_circles(p, sector);
    }
  }

  // By way of a direction beside that of the probe, towards one of A(x): with n the normal of a circle, into H-, n x does not fall on such ways. So they cross the circle as light does, and
  // passes_circles() need not be asked.
  static bool gets_there_by_a_ray(const Star<Interval>& star, const Beside<Interval>& from, const Vec3<Interval>& inner,
                                  const std::vector<Vec3<Interval>>& anticone) {
    return std::any_of(anticone.begin(), anticone.end(), [&](const Vec3<Interval>& ray) {
      try {
        const Vec3<Interval> between = balanced_sum<Interval>(from.limit, ray);
        return star.free_between(from, between) && star.is_free(between, inner);
      } catch (const Unsure&) {
        return false;
      }
    });
  }

  // T13. Let h be a plane through x with int V strictly in H+. Light gets next to x in directions into int V, which are in H+, and there its legs, being parts of rays from H+, cross the
  // circle of h from H+ to H- alone, and where no arc is. The inside of a sector is in H-. So a free part of the circle lies between the face of such directions and that of the sector; and
  // light that was in H- before stays in one face with it.
  bool passes_circles(std::size_t p, std::size_t sector) {
    Picture<Integer>& picture = around<Integer>();
    const Beside<Integer>& lit = picture.lit(p, seen_[p].probe).beside;
    const Vec3<Integer>& inner = picture.inside(sector, sector_of(sector)).inner;
    const bool into_cell = seen_[p].probe.kind == Probe::Kind::sight;
    seen_[p].faces.resize(circles_.size());
    for (std::size_t i = 0; i < circles_.size(); ++i) {
      Circle& c = circles_[i];
      if (!c.normal) {
        c.normal = normal_direction<Integer>(*c.plane);
        c.divides = picture.star.is_divided_by(*c.normal);
      }
      const int side = !c.divides ? 0 : into_cell ? -1 : lit.side_of(*c.normal);
      if (side == 0) continue;
      if (!c.star) {
        c.star.emplace(picture.star, *c.normal);
        c.across = c.star->across();
        c.inside.resize(apex_->sectors().size());
      }
      Face &from = seen_[p].faces[i], &to = c.inside[sector];
      if (from.empty()) from = c.star->face_of(into_cell ? lit.limit : c.star->moved(lit));
      if (to.empty()) to = c.star->face_of(inner);
      const bool passes =
          side > 0 ? from == to : std::find(c.across.begin(), c.across.end(), std::pair(from, to)) != c.across.end();
      if (!passes) return false;
    }
    return true;
  }

  const LocalScene* scene_;
  const Apex* apex_;
  std::vector<Seen> seen_;
  std::tuple<MadeOnce<Picture<Interval>>, MadeOnce<Picture<Integer>>> pictures_;
  std::vector<Circle> circles_;
};

LitSectors::LitSectors(const LocalScene& scene, const Apex& apex, const std::vector<const Plane*>& contours)
    : work_(std::make_unique<Work>(scene, apex, contours)) {}

LitSectors::~LitSectors() = default;

std::vector<std::uint32_t> LitSectors::existing(const std::vector<Probe>& probes) {
  if (probes.empty()) return {};
  std::vector<std::size_t> numbers;
  for (const Probe& p : probes) numbers.push_back(work_->number_of(p));
  return work_->existing(numbers);
}

}  // namespace clues::fastpath

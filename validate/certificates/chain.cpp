#include "validate/certificates/chain.h"

#include <optional>

#include "exact/sight/plain_sight.h"

namespace clues::validate {
namespace {

namespace plain = exact::plain;

// The s with x = v + s (y - v), if there is one.
std::optional<plain::Rational> place_on_line(const plain::Vec& v, const plain::Vec& y, const plain::Vec& x) {
  std::optional<plain::Rational> s;
  for (std::size_t i = 0; i < 3; ++i) {
    if (y[i] != v[i]) s = (x[i] - v[i]) / (y[i] - v[i]);
  }
  for (std::size_t i = 0; i < 3 && s; ++i) {
    if (x[i] - v[i] != *s * (y[i] - v[i])) return std::nullopt;
  }
  return s;
}

std::string flaw_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& given, const Chain& chain) {
  if (chain.links.empty()) return "the chain has no link";
  const plain::Cell cell(given);
  if (!cell.fault().empty()) return cell.fault();
  const plain::Scene scene(mesh);
  std::optional<plain::Vec> before;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const std::string link = "link " + std::to_string(i) + ": ";
    const plain::Vec v = plain::read(chain.links[i].v), x = plain::read(chain.links[i].x);
    const bool last = i + 1 == chain.links.size();
    if (!cell.interior_contains(v)) return link + "v is not in the relative interior of the cell";
    if (last) {
      const std::string flaw =
          scene.flaw_of_target(chain.triangle, chain.front, x, before.value_or(v), before ? "the point before" : "v");
      if (!flaw.empty()) return link + flaw;
    } else if (cell.contains(x)) {
      return link + "x is in the cell";
    }
    std::optional<plain::Cell::Outside> part = cell.outside_of(v, x);
    if (before) {
      const std::optional<plain::Rational> s = place_on_line(v, x, *before);
      if (!s) return link + "v, the point before and x are not on one line";
      if (sgn(*s) <= 0 || *s >= 1) return link + "the point before is not between v and x";
      part = plain::Cell::Outside{*s, true};
    }
    if (part) {
      if (const auto t = scene.blocker(v, x, *part))
        return link + "triangle " + std::to_string(*t) + " blocks the way to x";
    }
    if (!before) {  // the first x is to be in E (D6), and so seen from an open part of int V
      if (const auto t = scene.spoiler(cell, v, x))
        return link + "v lies on triangle " + std::to_string(*t) + ": choose another viewpoint";
    }
    if (last) {
      if (std::string flaw = scene.flaw_beside(chain.triangle, x); !flaw.empty()) return link + flaw;
    }
    before = x;
  }
  return "";
}

}  // namespace

ChainVerdict check_chain(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Chain& chain) {
  std::string flaw = flaw_of(mesh, cell, chain);
  return {flaw.empty(), std::move(flaw)};
}

}  // namespace clues::validate

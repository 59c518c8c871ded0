#!/usr/bin/env python3
"""Copies of our sources that take one decision wrongly. A program of tests that is linked with such a copy has to notice.

usage: plant.py sources ROOT           prints all sources that have copies, a line each
       plant.py source ROOT NAME       prints the source of which NAME is a copy
       plant.py write ROOT NAME FILE   writes the copy

ROOT is a checkout. Each text has to be in its source once: repair COPIES where it is not.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "mutation"))
from edits import NotFound, edited, source_of  # noqa: E402

# Name: (source, [(text, replacement), ...]).
COPIES = {
    # ---- solids (T15)

    # A window is covered if its middle is.
    "rims_forgotten": ("fastpath/section.cpp", [
        ("return held && !rim_meets(window, from_piece, to_piece);", "return held;")]),
    # A rim is passed beside if the viewer is beside it.
    "rims_beside_the_viewer": ("fastpath/section.cpp", [
        ("is_inside(*side, from_piece, scale_) && is_inside(*side, to_piece, scale_)",
         "is_inside(*side, from_piece, scale_) && !to_piece.corners.empty()")]),
    # A sloped facet is filled if a corner of it is.
    "sloped_doors_overlooked": ("fastpath/view_cell.cpp", [
        ("      return is_inside(side, piece, solids.scale())",
         "      const Point& corner = piece.corners[0];\n"
         "      return is_inside(side, Piece(std::span(&corner, 1)), solids.scale())")]),
    # A box without a lid is a solid.
    "open_solids": ("fastpath/solid.cpp", [
        ("return border.second != 0;", "return border.second > 1'000'000;")]),
    # Solids that the viewer may be in hide as all others do.
    "viewer_in_a_wall": ("fastpath/view_cell.cpp", [
        ("if (!is_outside(solids.all()[i])) around_", "if (i == ~0U) around_")]),
    # A facet is filled if its middle is.
    "doors_overlooked": ("fastpath/openings.cpp", [
        ("return enters_interior(*segment, both); })", "return enters_interior(*segment, both) && false; })")]),
    # A triangle is seen from behind if the cell reaches there.
    "behind_from_the_side": ("fastpath/view_cell.cpp", [
        ("return s.has_none_outside(corners_); });", "return !s.has_all_outside(corners_); });")]),
    # An edge of a section lies in the side that is in the section's own plane.
    "side_in_the_section": ("fastpath/exact_sections.cpp", [
        ("if (has(a) && has(b) && !has(third))", "if (has(a) && has(b) && (!has(third) || true))")]),
    # A corner of a section is where doubles say.
    "spots_without_errors": ("fastpath/exact_sections.cpp", [
        ("  ExactSpot s{x.value, y.value, {x.off, y.off}, false, nullptr};",
         "  ExactSpot s{x.value, y.value, {0, 0}, false, nullptr};")]),
    # A coordinate that is the same at both ends of an edge is a double.
    "rounded_edges": ("fastpath/exact_sections.cpp", [
        ("return same ? from : between(", "return same ? Estimate{from.value, 0} : between(")]),
    # Crossings are no further off than what they are of is rounded.
    "flat_crossings": ("fastpath/exact_sections.cpp", [
        ("off_share = 2 * errors / span + 0x1p-50;", "off_share = 0x1p-50;")]),
    # What touches the cell may be hidden.
    "touched_and_hidden": ("fastpath/view_cell.cpp", [
        ("return is_apart_from(target) && is_out_of_solids_around(target);", "return is_out_of_solids_around(target);")]),

    # ---- the reference

    # Wedges are looked for on the other side of the supporting planes.
    "wrong_wedge_side": ("reference/fixpoint.cpp", [
        ("    for (const ContourEdge& c : contours_) is_contour_.insert(c.edge);\n",
         "    for (ContourEdge& c : contours_) {\n"
         "      is_contour_.insert(c.edge);\n"
         "      c.plane = c.plane.opposite();\n"
         "    }\n")]),
    # A compound silhouette vertex has to be visible by what is known already.
    "retested_csv": ("reference/fixpoint.cpp", [
        ("    Apex* apex = c.at_vertex ? corner(c.id) : csv(c.id, c.at.p);\n",
         "    const Start start{c.at.p, std::nullopt, nullptr};\n"
         "    if (walker_.visible(start, walker_.walk(start, kSourceSeed), wedges_, 0) != Meets::yes) return;\n"
         "    Apex* apex = c.at_vertex ? corner(c.id) : csv(c.id, c.at.p);\n")]),
    # Parts of edges that wait for each other in a circle go on waiting (T12).
    "circles_wait": ("reference/fixpoint.cpp", [
        ("    for (const auto& [e, x] : cuts_of_circles(scene_, contours_, sources_)) new_cuts_[e].push_back(x);\n", "")]),
    # A walk ends at the first surface that it meets (D14).
    "no_rule_3": ("reference/walk.cpp", [
        ("    p = m;\n    surface = SurfaceSide{last.piece, front};\n    contour = nullptr;\n", "    return walk;\n")]),
    # A tolerance: strips that look narrow in doubles are taken for nothing.
    "rounded_comparison": ("reference/valid_pieces.cpp", [
        ("// Where the ray through `on_ray` starts",
         "bool is_narrow(const Strip& s, const Point3& center) {\n"
         "  const auto c = exact::to_double_estimate(center), a = exact::to_double_estimate(s.on_ray0.p),\n"
         "             b = exact::to_double_estimate(s.on_ray1.p);\n"
         "  double dot = 0, aa = 0, bb = 0;\n"
         "  for (std::size_t i = 0; i < 3; ++i) {\n"
         "    dot += (a[i] - c[i]) * (b[i] - c[i]);\n"
         "    aa += (a[i] - c[i]) * (a[i] - c[i]);\n"
         "    bb += (b[i] - c[i]) * (b[i] - c[i]);\n"
         "  }\n"
         "  return dot * dot > 0.98 * aa * bb;\n"
         "}\n\n"
         "// Where the ray through `on_ray` starts"),
        ("    ValidPiece piece{{}, on, strip, holds_cell};\n",
         "    if (is_narrow(strip, sector.center)) continue;\n"
         "    ValidPiece piece{{}, on, strip, holds_cell};\n")]),
    # With any of these: a wrong reference goes on where its walks disagree.
    "disagreeing_walks": ("reference/first_order.cpp", [
        ("  assert(map.statistics.walk_disagreements == 0);  // D14\n", "")]),

    # ---- simpler occlusion: steps as the published text has them

    # Hazard A-16: the chord that is taken runs outside the hidden region.
    "chord_outside": ("reference/boundary_simplification.cpp", [
        ("    if (turn == CGAL::RIGHT_TURN) return std::nullopt;\n",
         "    if (turn == CGAL::LEFT_TURN) return std::nullopt;\n"),
        ("made(r, i, false, {a, b, c})", "made(r, i, false, straight ? std::array{a, b, c} : std::array{a, c, b})")]),
    # Hazard A-17: the segments are extended on the outside.
    "extension_outside": ("reference/boundary_simplification.cpp", [
        ("  Simplifier(const Face2& face, const Kernel::Triangle_2& outline) {\n",
         "  Simplifier(const Face2& face, const Kernel::Triangle_2& outline) : outline_(outline) {\n"),
        ("  std::vector<Ring> rings_;\n};\n", "  const Kernel::Triangle_2& outline_;\n  std::vector<Ring> rings_;\n};\n"),
        ("    if (at_b == CGAL::LEFT_TURN && at_c == CGAL::LEFT_TURN) return std::nullopt;\n",
         "    if (at_b != CGAL::LEFT_TURN || at_c != CGAL::LEFT_TURN) return std::nullopt;\n"),
        ("    if (!x || CGAL::orientation(b, c, *x) != CGAL::LEFT_TURN) return std::nullopt;\n",
         "    if (!x || CGAL::orientation(b, c, *x) != CGAL::RIGHT_TURN) return std::nullopt;\n"
         "    if (outline_.has_on_unbounded_side(*x)) return std::nullopt;\n"),
        ("made(r, i, true, {b, c, *x})", "made(r, i, true, {b, *x, c})"),
        ("    if (at_b == CGAL::LEFT_TURN) step.may_touch = {b};\n    if (at_c == CGAL::LEFT_TURN) step.may_touch = {c};\n", ""),
        ("ring[step.at].p = step.lost[2];", "ring[step.at].p = step.lost[1];")]),
    # With either of these: nobody looks whether a hidden region grew.
    "growing_regions": ("reference/effective_occlusion.cpp", [
        ("    if (!subtract(hidden, set_with(false, old.at(order[k]), frame)).empty())\n"
         "      throw scene::Error(scene::ErrorCode::internal, \"simplification: a hidden region grew\");\n", "")]),

    # ---- the fast path

    # What the limits of D17 left out is asked about one place beside a side only, and not about all of the side.
    "one_sample_of_a_side": ("fastpath/sides.cpp", [
        ("    const std::array<IntervalBox, 3> corners{scene_.corner(t, 0).approximate(), scene_.corner(t, 1).approximate(),\n"
         "                                             scene_.corner(t, 2).approximate()};\n",
         "    const std::array<IntervalBox, 1> corners{p->approximate()};\n")]),

    # A wedge piece misses the inside of a triangle if one end of what its plane has there is beyond a side of it.
    "pieces_pass_beside": ("fastpath/one_label.cpp", [
        ("return first <= 0 && second <= 0 && first + second < 0;", "return first <= 0 || second <= 0;")]),
    # Of a triangle that lit ones pierce the parts on one side of each are asked about.
    "one_part_of_a_pierced_triangle": ("fastpath/darkness.cpp", [
        ("for (const int way : {1, -1}) {", "for (const int way : {1}) {")]),
    # What lies in the plane of a lit surface is asked about on the side that the cell is not on.
    "asked_on_the_far_side": ("fastpath/darkness.cpp", [
        ("dark_beside(t, side);", "dark_beside(t, -side);")]),
    # What is open is taken for all, whatever has not been asked about.
    "open_without_the_rest": ("fastpath/closure.cpp", [
        ("all_came_in_ = all_came_in_ && few;", "all_came_in_ = true;")]),
    # Of what is on the way to an open triangle that is kept which one corner of the cell looks past.
    "hull_of_one_corner": ("fastpath/open_part.cpp", [
        ("const Shaft shaft(bvh.frame(), bvh.corners(to[i]), corners);",
         "const Shaft shaft(bvh.frame(), bvh.corners(to[i]), std::span(corners).first(1));")]),

    # ---- refinement in the fast path

    # Hazard A-4: the raw adjusted wedge, which is the map of V+ without V-.
    "one_half_only": ("fastpath/refinement.cpp", [
        ("      Flags wanted = open;\n", "      cells.pop_back();\n      Flags wanted = open;\n")]),

    # ---- the exact visible set

    # Events of three planes are not remembered.
    "forget_triples": ("validate/moving_planes.cpp", [
        ("  if (p.remembered_for == visit_) return;\n", "  if (p.remembered_for == visit_ || p.planes[0] >= 0) return;\n")]),
    # What lies behind the cell blocks too.
    "block_behind_cell": ("validate/sight_window.cpp", [
        ("  if (shadow.way != Shadow::Way::cell) return true;\n", "  return true;\n")]),

    # ---- motion: what a walk in doubles relies on

    # The bin that the odometer was in is not looked at again.
    "skipped_bin": ("fastpath/calendar.cpp", [
        ("for (std::uint64_t bin = cursor_; bin <= last; ++bin)",
         "for (std::uint64_t bin = cursor_ + 1; bin <= last; ++bin)")]),
    # What a viewpoint goes aside costs a needle nothing.
    "needle_of_any_thickness": ("fastpath/delaunay_model.cpp", [
        ("return std::max(d, (away - (gauge.head - gauge.tail) * d * kDown) / gauge.tail) * kUp;",
         "return (gauge.head < 1 ? std::max(d, 0 * away) : away) * kUp;")]),
    # A bound is rounded up.
    "bound_rounded_up": ("fastpath/bounds.cpp", [
        ("return det.speed == 0 ? kInfinity : det.low / det.speed * kDown;",
         "return det.speed == 0 ? kInfinity : det.low / det.speed * kUp;")]),

    # ---- contours in doubles

    # A point is where doubles put it, and nothing is known to be off.
    "contour_boxes_without_width": ("fastpath/interval_drawing.cpp", [
        ("  return {common(place.x, around.x), common(place.y, around.y), common(place.z, around.z)};\n",
         "  const auto middle = [](const Interval& x) { return Interval(x.inf() / 2 + x.sup() / 2); };\n"
         "  return {middle(common(place.x, around.x)), middle(common(place.y, around.y)),\n"
         "          middle(common(place.z, around.z))};\n")]),
    # The last segment of each side is forgotten: the flood runs out there.
    "contour_segment_dropped": ("fastpath/side_graph.cpp", [
        ("s < drawn.segments.size(); ++s)", "s + 1 < drawn.segments.size(); ++s)")]),
    # No flood passes the last stretch of an edge of the scene with points on it.
    "contour_stretch_lost": ("fastpath/contour_decoder.cpp", [
        ("for (std::size_t g = 0; g + 1 < groups; ++g) {", "for (std::size_t g = 0; g + 2 < groups; ++g) {")]),
    # A face is not followed around the first corner of a point.
    "contour_corner_lost": ("fastpath/side_graph.cpp", [
        ("    for (std::size_t i = 0; i < outs.size(); ++i) join(",
         "    for (std::size_t i = outs.size() > 2 ? 1 : 0; i < outs.size(); ++i) join(")]),

    # ---- maps of surfaces

    # Neighbours are removed in one level.
    "neighbours_removed": ("reference/hierarchy.cpp", [
        ("for (const std::uint32_t w : removal->ring) blocked[w] = true;", "")]),
    # Of four corners on one circle the wrong diagonal.
    "wrong_cocircular_tie": ("reference/hole.cpp", [
        ("wanted = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? 1 : -1;",
         "wanted = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? -1 : 1;")]),
    # Weights sum to 1 but for 2^-60.
    "weights_miss_one": ("reference/overlay.cpp", [
        ("  return exact::rounded_point(weights, left);\n", "  return exact::rounded_point(weights, left - 1);\n")]),
    # A piece of the overlay is turned round.
    "flipped_piece": ("reference/overlay.cpp", [
        ("      hierarchy.pieces.push_back(piece);\n",
         "      if (hierarchy.pieces.size() == 5) std::swap(piece.corners[0], piece.corners[1]);\n"
         "      hierarchy.pieces.push_back(piece);\n")]),
    # The link condition is skipped for diagonals.
    "no_link_condition": ("reference/hierarchy.cpp", [
        ("const auto forbidden = [this](std::uint32_t a, std::uint32_t b) { return complex_.has_edge(a, b); };",
         "const auto forbidden = [](std::uint32_t, std::uint32_t) { return false; };")]),
    # The fast path takes the other diagonal of four corners on one circle.
    "fast_cocircular_tie": ("fastpath/hole_cover.cpp", [
        ("if (sign == 0) sign = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? 1 : -1;",
         "if (sign == 0) sign = std::min(number(c), number(d)) < std::min(number(a), number(b)) ? -1 : 1;")]),
    # The fast path asks the filter of circles without its error term.
    "fast_circle_without_error": ("fastpath/hole_cover.cpp", [
        ("in_circle_filtered(at_[a], at_[b], at_[c], at_[d])", "in_circle_filtered(at_[a], at_[b], at_[c], at_[d], 0)")]),
    # A cover that was made before an edge came between two of its corners is used as it is.
    "fast_stale_cover": ("fastpath/build.cpp", [
        ("(touched < 2 || joined == p.joined)", "true")]),
    # What is farthest from the remesh is not looked at.
    "remesh_bound_too_small": ("reference/remesh_error.cpp", [
        ("      to_remesh = std::max(to_remesh, square_bound(on(source, weights), triangle));\n",
         "      if (at.size() == 3) to_remesh = std::max(to_remesh, square_bound(on(source, weights), triangle));\n")]),
    # The vertices of a remesh lie a little beside their places.
    "remesh_vertex_moved": ("reference/remesh.cpp", [
        ("  scene::Point at = position_estimate(source, input);\n",
         "  scene::Point at = position_estimate(source, input);\n  at[0] += 0x1p-40;\n")]),
    # A star is carried to another place of its vertex with one spoke uncut. Points that lie in no triangle of it then go anywhere, but not out of bounds.
    "smoothing_without_a_cut": ("reference/smoothing.cpp", [
        ("flat.ring[static_cast<std::size_t>(corner - ring.vertices.begin())]",
         "flat.ring[static_cast<std::size_t>(corner - ring.vertices.begin()) % flat.ring.size()]"),
        ("    for (std::size_t k = 0; k < n; ++k) {\n      if (!cut_along(",
         "    for (std::size_t k = 1; k < n; ++k) {\n      if (!cut_along("),
        ("      if (!lies_in(closing[t], a.image) || !lies_in(closing[t], b.image) || !lies_in(closing[t], c.image)) continue;\n"
         "      if (exact::orientation_in(closing[t], a.image, b.image, c.image) > 0) return t;\n",
         "      if (lies_in(closing[t], a.image)) return t;\n")]),
}


def main():
    command, root, *rest = sys.argv[1:]
    if command == "sources":
        print(*sorted({str(source_of(pathlib.Path(root), source)) for source, _ in COPIES.values()}), sep="\n")
        return
    name, *out = rest
    source, edits = COPIES[name]
    try:
        path = source_of(pathlib.Path(root), source)
        text = path.read_text()
        for old, new in edits:
            text = edited(source, text, old, new)
    except NotFound as error:
        sys.exit(f"plant.py: {name}: {error}")
    if command == "source":
        print(path)
    else:
        pathlib.Path(out[0]).write_text(text)


if __name__ == "__main__":
    main()

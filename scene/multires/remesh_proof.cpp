#include "scene/multires/remesh_proof.h"

#include <cmath>
#include <limits>

#include "scene/formats/file_bytes.h"
#include "scene/multires/list_reader.h"

namespace clues::scene {
namespace {

// Coordinates that are too large for the arithmetic of bounds have none.
std::string bound_text(double bound) { return std::isfinite(bound) ? fmt::format("{}", bound) : "none"; }

double bound_of(ListReader& in) {
  const std::string_view token = in.word("bound");
  if (token == "none") return std::numeric_limits<double>::infinity();
  const auto number = parse_number(token);
  if (number.kind != NumberKind::finite || number.value < 0)
    in.fail(fmt::format("{} is no bound: a number from 0 up, or 'none'", excerpt(token)));
  return number.value;
}

}  // namespace

std::string to_text(const RemeshProof& proof) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "clues-remesh 1\nbounds {} {}\n", bound_text(proof.to_remesh), bound_text(proof.to_input));
  fmt::format_to(to, "parameters {}\n", proof.parameters.size());
  for (const auto& p : proof.parameters) {
    write_point(out, p);
    out.push_back('\n');
  }
  write_triangles(out, "triangles", proof.triangles);
  write_points(out, proof.points);
  fmt::format_to(to, "pieces {}\n", proof.pieces.size());
  for (std::size_t k = 0; k < proof.pieces.size(); ++k) {
    const auto& piece = proof.pieces[k];
    fmt::format_to(to, "{} {} {} {} {}\n", piece.corners[0], piece.corners[1], piece.corners[2], piece.input,
                   proof.near[k]);
  }
  return fmt::to_string(out);
}

RemeshProof parse_remesh_proof(std::string_view text, const std::string& file, std::size_t input_vertices,
                               std::size_t input_triangles) {
  ListReader in(file, text);
  in.next_line("clues-remesh 1");
  if (in.word("the format") != "clues-remesh")
    in.fail("this is no proof of a remesh of clues maps; its first line is 'clues-remesh 1'");
  if (in.word("version") != "1") in.fail("this version of clues reads 'clues-remesh 1' only");
  in.end_line();
  RemeshProof proof;
  in.next_line("bounds");
  if (in.word("bounds") != "bounds") in.fail("the second line begins with 'bounds'");
  proof.to_remesh = bound_of(in);
  proof.to_input = bound_of(in);
  in.end_line();
  in.list("parameters", [&] { proof.parameters.push_back(in.point(input_vertices)); });
  in.list("triangles", [&] { proof.triangles.push_back(in.triangle(proof.parameters.size())); });
  in.list("points", [&] {
    OverlayVertex p;
    p.source = in.point(input_vertices);
    p.image = in.point(proof.parameters.size());
    proof.points.push_back(p);
  });
  in.list("pieces", [&] {
    OverlayTriangle t;
    for (auto& c : t.corners) c = in.index("point", proof.points.size());
    t.input = in.index("triangle", input_triangles);
    proof.pieces.push_back(t);
    proof.near.push_back(in.index("triangle", input_triangles));
  });
  in.end_file();
  return proof;
}

RemeshProof read_remesh_proof(const std::filesystem::path& path, std::size_t input_vertices,
                              std::size_t input_triangles) {
  return parse_remesh_proof(read_file_bytes(path), path.string(), input_vertices, input_triangles);
}

}  // namespace clues::scene

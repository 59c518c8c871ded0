#include "tests/app/finding_fixture.h"

#include "fuzz/shrinking/finding_folder.h"

namespace clues::tests {

void make_finding(const std::filesystem::path& folder) {
  fuzz::SavedFinding saved;
  fuzz::Finding& f = saved.finding;
  f.oracle = "sight-lines";
  f.verdict = "hidden/visible";
  f.explanation = "a free sight line ends on a triangle that is called hidden";
  f.where.generator = "loose_triangles";
  f.where.seed = 1;
  f.where.mesh.points = {{-20, -20, 4}, {20, -20, 4}, {20, 20, 4},        {-20, 20, 4},      {-6, -4, 2},
                         {6, -4, 2},    {0, 8, 2},    {-0.5, -0.5, 2.25}, {0.5, -0.5, 2.25}, {0, 0.5, 2.25},
                         {9, 0, 2},     {10, 0, 2},   {9, 1, 2}};
  f.where.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}, {7, 9, 8}, {10, 12, 11}};
  f.where.mesh.face_of = {0, 1, 2, 3, 4};
  for (const double z : {-0.25, 0.0}) {
    for (const double y : {-0.25, 0.25}) {
      for (const double x : {-0.25, 0.25}) f.where.cell.push_back({x, y, z});
    }
  }
  f.triangle = 4;
  f.witness = fuzz::WitnessText{4, true, {"0", "0", "-1/8"}, {"2364/251", "84/251", "2"}};
  saved.subject = "reference";
  saved.original = f;
  fuzz::save_finding(saved, folder);
}

}  // namespace clues::tests

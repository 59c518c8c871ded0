#include "fuzz/findings/files.h"

#include <fmt/format.h>

namespace clues::fuzz {

std::string points_as_obj(const std::vector<scene::Point>& points) {
  std::string text = "# a view cell: the convex hull of these points\n";
  for (const scene::Point& p : points)
    text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);  // shortest that reads back
  return text;
}

}  // namespace clues::fuzz

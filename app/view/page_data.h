// What goes into a page of `clues view`: files as the page reads them when they are dropped, but for meshes, which are binary, and for what it does not draw, which is
// left out ("clues-view/1", docs/viewer.md). Here are those that are made and not read (`clues demo`); view_data.h reads files.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/mesh/mesh.h"
#include "scene/result.h"

namespace clues::app {

class PageData {
 public:
  // An object with "path", the name of the file, and what is in it.
  void put(nlohmann::json file) { files_.push_back(std::move(file)); }
  // Names are without folders. A result is of a scene that was added. O(size).
  void add_scene(const std::string& name, const scene::TriangleMesh& mesh, const std::string& sha256);
  void add_result(const std::string& name, const scene::Result& result);

  std::size_t count() const { return files_.size(); }
  std::string text() const;  // JSON; doubles as they are, the same files give the same bytes

 private:
  nlohmann::json files_ = nlohmann::json::array();
};

}  // namespace clues::app

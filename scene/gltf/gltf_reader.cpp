#include "scene/gltf/gltf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scene/gltf/gltf_accessor.h"
#include "scene/gltf/gltf_transform.h"
#include "scene/messages/warning.h"

namespace clues::scene {
namespace {

enum Mode : std::uint64_t { points = 0, line_strip = 3, triangles = 4, strip = 5, fan = 6 };

std::string named(const char* item, std::uint32_t index, const GltfObject& object) {
  const std::string name = object.text("name", "");
  return name.empty() ? fmt::format("{} {}", item, index) : fmt::format("{} {} ({})", item, index, name);
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file, const BufferLoader& load)
      : file_(file),
        document_(bytes, file, load),
        moves_(document_.nodes().size()),
        seen_(document_.nodes().size()),
        material_changes_(document_.materials().size()) {}

  FlaggedMesh read() {
    find_animated();
    struct Open {
      std::uint32_t node;
      Transform above;
      bool moves;
    };
    std::vector<Open> open;
    const auto push = [&](const std::vector<std::uint32_t>& nodes, const Transform& above, bool moves) {
      for (auto i = nodes.rbegin(); i != nodes.rend(); ++i) open.push_back({*i, above, moves});
    };
    push(roots(), {}, false);
    while (!open.empty()) {
      const auto [index, above, moves] = open.back();
      open.pop_back();
      const GltfObject& node = document_.nodes()[index];
      if (seen_[index]) node.fail("is reached twice; nodes form a tree");
      seen_[index] = true;
      if (node.has_extension("EXT_mesh_gpu_instancing"))
        fail_at(node.place, ErrorCode::unsupported,
                "uses EXT_mesh_gpu_instancing, which is not read; export its instances as nodes");
      const Transform here = product(above, transform_of(node));
      const bool moves_here = moves || moves_[index] || may_not_be_drawn(node);
      if (const auto mesh = node.index("mesh", "mesh", document_.meshes().size()))
        add_mesh(index, *mesh, here, moves_here);
      push(node.indices("children", "node", document_.nodes().size()), here, moves_here);
    }
    say_what_was_left_out();
    return finished();
  }

 private:
  // What an animation moves does not stand where the file puts it.
  void find_animated() {
    for (const auto& animation : document_.root().objects("animations", "animation")) {
      for (const auto& channel : animation.objects("channels", "animation channel")) {
        const auto target = channel.object("target");
        const auto node = target ? target->index("node", "node", document_.nodes().size()) : std::nullopt;
        if (node) moves_[*node] = true;
        if (target) find_pointed_at(*target);
      }
    }
  }

  // An animation may name what it changes by a path: "/nodes/3/translation".
  void find_pointed_at(const GltfObject& target) {
    const auto extensions = target.object("extensions");
    const auto extension = extensions ? extensions->object("KHR_animation_pointer") : std::nullopt;
    if (!extension) return;
    const std::string pointer = extension->text("pointer", "");
    const auto mark = [&](std::string_view list, std::vector<bool>& marks) {
      if (!pointer.starts_with(list)) return;
      const std::string number = pointer.substr(list.size(), pointer.find('/', list.size()) - list.size());
      const bool is_number =
          !number.empty() && number.size() <= 9 && number.find_first_not_of("0123456789") == std::string::npos;
      if (!is_number || std::stoul(number) >= marks.size())
        target.fail("its KHR_animation_pointer " + excerpt(pointer) + " points at nothing");
      marks[std::stoul(number)] = true;
    };
    mark("/nodes/", moves_);
    mark("/materials/", material_changes_);
  }

  // Switched off, or one of several levels of detail of which a renderer draws another: what stands behind it may be seen.
  static bool may_not_be_drawn(const GltfObject& node) {
    const auto extensions = node.object("extensions");
    if (!extensions) return false;
    const auto visibility = extensions->object("KHR_node_visibility");
    return (visibility && visibility->find("visible") != nullptr && !visibility->flag("visible")) ||
           extensions->find("MSFT_lod") != nullptr;
  }

  std::vector<std::uint32_t> roots() {
    const auto scenes = document_.root().objects("scenes", "scene");
    const std::size_t count = document_.nodes().size();
    const auto chosen = document_.root().index("scene", "scene", scenes.size());
    if (scenes.size() > 1) {
      warn(fmt::format("{}: the file has {} scenes; scene {} is read and the others are left out", file_, scenes.size(),
                       chosen.value_or(0)));
    }
    if (!scenes.empty()) return scenes[chosen.value_or(0)].indices("nodes", "node", count);
    std::vector<bool> is_child(count);
    for (const auto& node : document_.nodes()) {
      for (const auto child : node.indices("children", "node", count)) is_child[child] = true;
    }
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    return roots;
  }

  // With its material, and with every other one that it may be given.
  bool is_opaque(const GltfObject& primitive) const {
    const std::size_t count = document_.materials().size();
    const auto index = primitive.index("material", "material", count);
    if (index && !is_opaque_material(*index)) return false;
    const auto extensions = primitive.object("extensions");
    const auto variants = extensions ? extensions->object("KHR_materials_variants") : std::nullopt;
    if (!variants) return true;
    const auto mappings = variants->objects("mappings", "mapping");
    return std::all_of(mappings.begin(), mappings.end(), [&](const GltfObject& mapping) {
      return is_opaque_material(mapping.needed_index("material", "material", count));
    });
  }

  bool is_opaque_material(std::uint32_t index) const {
    const GltfObject& material = document_.materials()[index];
    const std::string alpha = material.text("alphaMode", "OPAQUE");
    if (alpha != "OPAQUE" && alpha != "MASK" && alpha != "BLEND")
      material.fail("its alphaMode is " + excerpt(alpha) + ", and not OPAQUE, MASK or BLEND");
    if (alpha != "OPAQUE" || material_changes_[index]) return false;
    const auto extensions = material.object("extensions");
    if (!extensions) return true;
    const auto lets_light_through = [](const auto& item) {
      const std::string& name = item.key();
      return name.find("transmission") != std::string::npos || name.find("transparency") != std::string::npos ||
             name == "MSFT_lod";
    };
    return std::none_of(extensions->json->items().begin(), extensions->json->items().end(), lets_light_through);
  }

  void add_mesh(std::uint32_t node, std::uint32_t index, const Transform& transform, bool moves) {
    const GltfObject& mesh = document_.meshes()[index];
    const bool bends = moves || document_.nodes()[node].find("skin") != nullptr;
    std::uint32_t number = 0;
    for (GltfObject primitive : mesh.objects("primitives", "mesh")) {
      primitive.place.number = index;
      const bool morphs = primitive.find("targets") != nullptr;
      if (bends || morphs) ++moving_;
      parts_.push_back({static_cast<std::uint32_t>(out_.triangles.size()),
                        fmt::format("{} / {} / primitive {}", named("node", node, document_.nodes()[node]),
                                    named("mesh", index, mesh), number)});
      add_primitive(primitive, transform, !bends && !morphs && is_opaque(primitive));
      if (parts_.back().first_triangle == out_.triangles.size()) parts_.pop_back();
      ++number;
    }
  }

  void add_primitive(const GltfObject& primitive, const Transform& transform, bool blocks) {
    const std::uint64_t mode = primitive.whole("mode", fan).value_or(triangles);
    if (mode <= line_strip) {
      ++lines_;
      return;
    }
    const auto attributes = primitive.object("attributes");
    if (!attributes) primitive.fail("a primitive has no \"attributes\"");
    const auto position = attributes->index("POSITION", "accessor", document_.accessors().size());
    if (!position) return;  // the format: such a primitive is not drawn
    const auto& local = positions_of(*position);
    const auto indices = indices_of(primitive, local.size());
    const std::size_t corners = indices ? indices->size() : local.size();
    if (mode == triangles && corners % 3 != 0)
      primitive.fail(fmt::format("a primitive of {} corners, which is no multiple of 3", corners));
    const std::size_t count = mode == triangles ? corners / 3 : corners < 3 ? 0 : corners - 2;
    if (out_.points.size() + local.size() > most_elements || out_.triangles.size() + count > most_elements) {
      fail_at(primitive.place, ErrorCode::unsupported,
              fmt::format("with it the scene has more than {} points or triangles; split it", most_elements));
    }
    const auto first = static_cast<std::uint32_t>(out_.points.size());
    for (const Point& p : local) {
      out_.points.push_back(transform(p));
      for (const double x : out_.points.back()) {
        if (!std::isfinite(x))
          fail_at(primitive.place, ErrorCode::non_finite,
                  "a point has no finite place after the transforms of its nodes; scale the scene down");
      }
    }
    const bool turned = transform.mirrors();
    const auto corner = [&](std::size_t i) {
      return first + (indices ? (*indices)[i] : static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i < count; ++i) {
      Triangle t = mode == triangles ? Triangle{corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)}
                   : mode == strip   ? Triangle{corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)}
                                     : Triangle{corner(i + 1), corner(i + 2), corner(0)};
      if (turned) std::swap(t[1], t[2]);
      out_.face_of.push_back(static_cast<std::uint32_t>(out_.triangles.size()));
      out_.triangles.push_back(t);
    }
    blocks_.resize(out_.triangles.size(), blocks ? 1 : 0);
  }

  // The mesh of several nodes is read once.
  const std::vector<Point>& positions_of(std::uint32_t accessor) {
    const auto [entry, is_new] = positions_.try_emplace(accessor);
    if (is_new) entry->second = read_positions(document_, accessor);
    return entry->second;
  }

  std::optional<std::vector<std::uint32_t>> indices_of(const GltfObject& primitive, std::size_t count) {
    const auto accessor = primitive.index("indices", "accessor", document_.accessors().size());
    if (!accessor) return std::nullopt;
    auto indices = read_indices(document_, *accessor);
    const auto most = std::max_element(indices.begin(), indices.end());
    if (most != indices.end() && *most >= count) {
      fail_at(document_.accessors()[*accessor].place, ErrorCode::index_out_of_range,
              fmt::format("vertex {} does not exist: the primitive has {}; export the file again", *most, count));
    }
    return indices;
  }

  void say_what_was_left_out() const {
    if (lines_ > 0)
      warn(fmt::format("{}: {} primitives of points or lines have no surface and are left out", file_, lines_));
    if (moving_ > 0)
      warn(
          fmt::format("{}: {} primitives move, bend or may be hidden (skin, morph targets, animation, visibility or "
                      "levels of detail); they count where they are drawn at rest, and block nothing",
                      file_, moving_));
  }

  FlaggedMesh finished() {
    FlaggedMesh mesh;
    mesh.mesh = std::move(out_);
    mesh.parts = std::move(parts_);
    if (std::find(blocks_.begin(), blocks_.end(), 0) != blocks_.end()) mesh.blocks = std::move(blocks_);
    return mesh;
  }

  const std::string& file_;
  GltfDocument document_;
  std::vector<bool> moves_, seen_;      // per node
  std::vector<bool> material_changes_;  // by an animation
  std::map<std::uint32_t, std::vector<Point>> positions_;
  TriangleMesh out_;
  std::vector<std::uint8_t> blocks_;
  std::vector<MeshPart> parts_;
  std::uint64_t lines_ = 0, moving_ = 0;
};

}  // namespace

FlaggedMesh read_gltf(std::string_view bytes, const std::string& file, const BufferLoader& load) {
  return Reader(bytes, file, load).read();
}

}  // namespace clues::scene

#include "fastpath/visibility/engine_part.h"

#include <memory>
#include <optional>
#include <utility>

namespace clues::fastpath {
namespace {

class EnginePart : public PartialMap {
 public:
  explicit EnginePart(LocalMap map) : map_(std::move(map)) {}

  // What light meets, on either side: the closure asks for that in solid mode too.
  std::vector<std::uint32_t> visible() const override { return map_.lit(); }
  SetLabel label(const Box& box) const override { return map_.label(box); }
  SetLabel label_of_inside(std::span<const ExactPoint> polygon, const Box& about) const override {
    return map_.label_of_inside(polygon, about);
  }
  SetLabel label_beside(const Corners& triangle, const Box& about) const override {
    return map_.label_beside(triangle, about);
  }

  bool piece_may_touch(const Corners& triangle) const override { return map_.piece_may_touch(triangle); }
  bool has_fallbacks() const override { return map_.counts().conservative_fallbacks > 0; }

  const LocalMap& map() const { return map_; }

 private:
  LocalMap map_;
};

}  // namespace

const LocalMap* ClosedScene::map() const {
  return closure.map ? &static_cast<const EnginePart&>(*closure.map).map() : nullptr;
}

std::uint64_t ClosedScene::fallbacks() const {
  const std::uint64_t of_map = map() ? map()->counts().conservative_fallbacks + map()->conservative_labels() : 0;
  return of_map + closure.unproved.size();
}

Box outside_of(const Bvh& bvh) {
  const LocalFrame& frame = bvh.frame();
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = frame.center[i] - 2 / frame.scale;
    box.high[i] = frame.center[i] + 2 / frame.scale;
  }
  return box;
}

ClosedScene close_by_engine(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                            const Box& outside, exact::CutMemory& memory, std::span<const std::uint32_t> guess,
                            std::span<const std::uint8_t> counting, Wanted wanted) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  std::optional<std::size_t> first;
  const auto make_map = [&](const ScenePart& part, PartStage stage) -> std::shared_ptr<const PartialMap> {
    const std::size_t mapped = mapped_of(part.ids, part.dark).size();
    if (!first) first = mapped;
    LocalMapOptions of_part = options;
    if (stage == PartStage::grown) {
      of_part.effort = effort_of_first_try(of_part.effort);
    } else if (stage != PartStage::least) {
      of_part.effort = effort_of_next_try(of_part.effort);
    }
    if (stage == PartStage::grown || stage == PartStage::rest)
      of_part.effort = effort_of_part(of_part.effort, mapped, *first);
    // A map that leaves out many CSVs is better than none.
    of_part.csvs_by_effort = options.effort > 0 && stage != PartStage::least;
    try {
      return std::make_shared<const EnginePart>(
          make_local_map({part.mesh, part.ids, part.dark, memory}, exact_cell, of_part, &outside));
    } catch (const EffortSpent&) {
      return nullptr;
    }
  };
  return {close_over_visible(bvh, Cell(exact_cell), make_map, kMappedWhole, options.dials, guess, counting, wanted)};
}

}  // namespace clues::fastpath

// The reference and the fast path as subjects, and programs that are given files.
#include "fuzz/campaign/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement.h"
#include "fuzz/campaign/files.h"
#include "reference/visibility/bounds.h"
#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/mesh_io.h"
#include "scene/result.h"
#include "scene/temporary_folder.h"
#include "validate/conform/child_process.h"
#include "validate/conform/program_subject.h"
#include "validate/precision.h"

namespace clues::fuzz {
namespace {

using reference::PlantedBug;
using scene::Error;
using scene::ErrorCode;

const std::map<std::string, PlantedBug> planted_bugs{{"wrong_wedge_side", PlantedBug::wrong_wedge_side},
                                                     {"retested_csv", PlantedBug::retested_csv},
                                                     {"no_rule_3", PlantedBug::no_rule_3},
                                                     {"rounded_comparison", PlantedBug::rounded_comparison}};

[[noreturn]] void throw_no_answer(const Error& error) {
  if (error.code() == ErrorCode::not_solid) throw InputRefused(error.what());
  throw NoAnswer(error.what());
}

class ReferenceSubject : public Subject {
 public:
  ReferenceSubject(std::string name, PlantedBug bug) : name_(std::move(name)) {
    options_.threads = 1;
    options_.planted_bug = bug;
  }

  Answer answer(const Case& scene) const override {
    reference::Options options = options_;
    if (scene.solid) options.mode = reference::Mode::solid;
    Answer out;
    try {
      out.map = reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
    } catch (const Error& error) {
      throw_no_answer(error);
    }
    out.pvs = out.map->visible;
    return out;
  }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  reference::Options options_;
};

// The reference, refined (D20, D21): hidden regions of its map are judged like those of the first-order map.
class RefinedSubject : public Subject {
 public:
  RefinedSubject(std::string name, validate::Refinement by) : name_(std::move(name)), by_(by) {}

  Answer answer(const Case& scene) const override {
    reference::Options options;
    options.threads = 1;
    if (scene.solid) options.mode = reference::Mode::solid;
    try {
      reference::Bounds bounds(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
      validate::refine(bounds, by_, {kDepth, 0});
      Answer out;
      out.map = bounds.refined_map(name_);
      out.pvs = out.map->visible;
      return out;
    } catch (const Error& error) {
      throw_no_answer(error);
    }
  }
  std::string name() const override { return name_; }

 private:
  static constexpr int kDepth = 2;
  std::string name_;
  validate::Refinement by_;
};

fastpath::LocalMapOptions fast_options(const Case& scene) {
  fastpath::LocalMapOptions options;
  if (scene.solid) {
    fastpath::require_solid(scene.mesh);
    options.mode = fastpath::SideMode::solid;
  }
  return options;
}

class RefinedFastSubject : public Subject {
 public:
  RefinedFastSubject(std::string name, fastpath::RefineBy by) : name_(std::move(name)), by_(by) {}

  Answer answer(const Case& scene) const override {
    fastpath::RefinementOptions refinement;
    refinement.by = by_;
    refinement.max_depth = kDepth;
    try {
      const auto found =
          fastpath::refined_visibility(fastpath::Bvh(scene.mesh), scene.cell, fast_options(scene), refinement);
      return {found.visible, std::nullopt, std::nullopt};
    } catch (const Error& error) {
      throw_no_answer(error);
    }
  }
  std::string name() const override { return name_; }

 private:
  static constexpr int kDepth = 3;
  std::string name_;
  fastpath::RefineBy by_;
};

class FastSubject : public Subject {
 public:
  Answer answer(const Case& scene) const override {
    try {
      const fastpath::FirstOrder found =
          fastpath::first_order_visibility(fastpath::Bvh(scene.mesh), scene.cell, fast_options(scene));
      return {found.visible, std::nullopt, found.conservative_fallbacks};
    } catch (const Error& error) {
      throw_no_answer(error);
    }
  }
  std::string name() const override { return "fast"; }
};

class FunctionSubject : public Subject {
 public:
  FunctionSubject(std::string name, std::function<std::vector<std::uint32_t>(const Case&)> pvs)
      : name_(std::move(name)), pvs_(std::move(pvs)) {}

  Answer answer(const Case& scene) const override {
    try {
      return {pvs_(scene), std::nullopt, std::nullopt};
    } catch (const Error& error) {
      throw_no_answer(error);
    }
  }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  std::function<std::vector<std::uint32_t>(const Case&)> pvs_;
};

class CommandSubject : public Subject {
 public:
  explicit CommandSubject(std::string text) : text_(std::move(text)), words_(validate::split_command(text_)) {
    if (words_.empty()) throw Error(ErrorCode::bad_argument, "--subject: no command");
    const bool placed = std::any_of(words_.begin(), words_.end(), [](const std::string& w) {
      return w.find("{scene}") != w.npos || w.find("{cell}") != w.npos || w.find("{pvs}") != w.npos;
    });
    if (!placed) words_.insert(words_.end(), {"{scene}", "{cell}", "{pvs}"});
  }

  Answer answer(const Case& scene) const override {
    const scene::TemporaryFolder folder;
    const std::string pvs = folder.file("pvs.txt");
    scene::write_file_atomically(folder.file("scene.off"), scene::to_off_text(scene.mesh));
    scene::write_file_atomically(folder.file("cell.obj"), points_as_obj(scene.cell));
    std::vector<std::string> words = words_;
    for (std::string& word : words) {
      replace(word, "{scene}", folder.file("scene.off"));
      replace(word, "{cell}", folder.file("cell.obj"));
      replace(word, "{pvs}", pvs);
      replace(word, "{mode}", scene.solid ? "solid" : "sheet");
    }
    validate::ChildProcess child(words, 0);
    const auto end = child.finish(validate::ChildProcess::Clock::now() + time_limit);
    if (end.killed_here) throw NoAnswer(fmt::format("no answer within {} s", time_limit.count()));
    if (end.exit_code != 0) throw NoAnswer(validate::describe(end) + ": " + child.stderr_tail());
    try {
      return {scene::read_pvs(pvs, scene.mesh.triangles.size()), std::nullopt, std::nullopt};
    } catch (const Error& error) {
      throw NoAnswer(error.what());
    }
  }
  std::string name() const override { return text_; }

 private:
  static constexpr std::chrono::seconds time_limit{60};

  static void replace(std::string& word, const std::string& key, const std::string& value) {
    for (auto at = word.find(key); at != word.npos; at = word.find(key, at + value.size()))
      word.replace(at, key.size(), value);
  }

  std::string text_;
  std::vector<std::string> words_;
};

}  // namespace

std::unique_ptr<Subject> subject_of(std::string name, std::function<std::vector<std::uint32_t>(const Case&)> pvs) {
  return std::make_unique<FunctionSubject>(std::move(name), std::move(pvs));
}

std::unique_ptr<Subject> make_subject(const std::string& text) {
  if (text == "reference") return std::make_unique<ReferenceSubject>(text, PlantedBug::none);
  if (text == "fast") return std::make_unique<FastSubject>();
  if (text == "subdivided") return std::make_unique<RefinedSubject>(text, validate::Refinement::cells);
  if (text == "backprojected") return std::make_unique<RefinedSubject>(text, validate::Refinement::backprojection);
  if (text == "fast:subdivided") return std::make_unique<RefinedFastSubject>(text, fastpath::RefineBy::cells);
  if (text == "fast:backprojected")
    return std::make_unique<RefinedFastSubject>(text, fastpath::RefineBy::backprojection);
  const std::string prefix = "reference:";
  if (text.starts_with(prefix)) {
    const auto bug = planted_bugs.find(text.substr(prefix.size()));
    if (bug == planted_bugs.end())
      throw Error(ErrorCode::bad_argument,
                  "--subject " + text + ": no such planted bug; `clues fuzz --help` lists the subjects");
    return std::make_unique<ReferenceSubject>(text, bug->second);
  }
  return std::make_unique<CommandSubject>(text);
}

}  // namespace clues::fuzz

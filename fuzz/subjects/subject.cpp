// The reference and the fast path as subjects, and programs that are given files.
#include "fuzz/subjects/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "fastpath/solids/find_solids.h"
#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "fuzz/findings/case_random.h"
#include "fuzz/findings/dials.h"
#include "fuzz/findings/files.h"
#include "fuzz/trials/bakes_trial.h"
#include "fuzz/trials/deltas_trial.h"
#include "fuzz/trials/levels_trial.h"
#include "fuzz/trials/maps_trial.h"
#include "fuzz/trials/motion_trial.h"
#include "fuzz/trials/streams_trial.h"
#include "reference/visibility/refinement/bounds.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "validate/conform/program_subject.h"
#include "validate/processes/child_process.h"
#include "validate/verdicts/precision.h"

namespace clues::fuzz {
namespace {

using scene::Error;
using scene::ErrorCode;

[[noreturn]] void throw_no_answer(const Error& error) {
  if (error.code() == ErrorCode::not_solid) throw InputRefused(error.what());
  throw NoAnswer(error.what());
}

// A subject of this process; an engine of ours takes dials.
class FunctionSubject : public Subject {
 public:
  FunctionSubject(std::string name, bool engine, std::function<Answer(const Case&)> answer)
      : name_(std::move(name)), engine_(engine), answer_(std::move(answer)) {}

  Answer answer(const Case& scene) const override {
    const exact::TurnedProcessDials turned(engine_ ? process_dials(scene.dials) : exact::ProcessDials{});
    try {
      return answer_(scene);
    } catch (const Error& error) {
      throw_no_answer(error);
    }
  }
  std::string name() const override { return name_; }
  bool takes_dials() const override { return engine_; }

 private:
  std::string name_;
  bool engine_;
  std::function<Answer(const Case&)> answer_;
};

std::unique_ptr<Subject> engine(const std::string& name, std::function<Answer(const Case&)> answer) {
  return std::make_unique<FunctionSubject>(name, true, std::move(answer));
}

Answer answer_of(reference::VisibilityMap map) {
  Answer out;
  out.pvs = map.visible;
  out.map = std::move(map);
  return out;
}

reference::Options reference_options(const Case& scene) {
  reference::Options options;
  options.threads = 1;
  options.dials = map_dials(scene.dials);
  if (by_traversal(scene.dials)) options.formulation = reference::Formulation::traversal;
  if (scene.solid) options.mode = reference::Mode::solid;
  return options;
}

fastpath::LocalMapOptions fast_options(const Case& scene) {
  fastpath::LocalMapOptions options;
  options.dials = map_dials(scene.dials);
  if (scene.solid) {
    fastpath::require_solid(scene.mesh);
    options.mode = fastpath::SideMode::solid;
  }
  return options;
}

std::unique_ptr<Subject> reference_subject(const std::string& name) {
  return engine(name, [](const Case& scene) {
    return answer_of(reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(scene.cell),
                                                       reference_options(scene)));
  });
}

// The reference, refined (D20, D21): hidden regions of its map are judged like those of the first-order map.
std::unique_ptr<Subject> refined_subject(const std::string& name, validate::Refinement by) {
  constexpr int kDepth = 2;
  return engine(name, [name, by](const Case& scene) {
    reference::Bounds bounds(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), reference_options(scene));
    validate::refine(bounds, by, {refinement_depth(scene.dials, kDepth), 0});
    return answer_of(reference::moved_back(bounds.refined_map(name)));
  });
}

// One case in so many is compared with the reference: which, its name and dials say.
class ComparedSubject : public FunctionSubject {
 public:
  ComparedSubject(std::string name, std::uint64_t one_in, std::function<Answer(const Case&)> answer)
      : FunctionSubject(std::move(name), true, std::move(answer)), one_in_(one_in) {}
  bool is_compared(const Case& scene) const override {
    return one_in_ == 1 || random_for(scene, "comparison").next() % one_in_ == 0;
  }

 private:
  std::uint64_t one_in_;
};

std::unique_ptr<Subject> fast_subject(const std::string& name) {
  return std::make_unique<ComparedSubject>(name, *cases_for_a_comparison(name), [](const Case& scene) {
    const fastpath::FirstOrder found = fastpath::first_order_visibility(fastpath::Bvh(scene.mesh), scene.cell,
                                                                        fast_options(scene), {.in_doubt = true});
    return Answer{found.visible, std::nullopt, found.in_doubt};
  });
}

std::unique_ptr<Subject> refined_fast_subject(const std::string& name, fastpath::RefineBy by) {
  constexpr int kDepth = 3;
  return engine(name, [by](const Case& scene) {
    fastpath::RefinementOptions refinement;
    refinement.by = by;
    refinement.max_depth = refinement_depth(scene.dials, kDepth);
    return Answer{
        fastpath::refined_visibility(fastpath::Bvh(scene.mesh), scene.cell, fast_options(scene), refinement).visible,
        std::nullopt, std::nullopt};
  });
}

// T15. What sees in solid mode sees in sheet mode.
std::unique_ptr<Subject> solids_subject(const std::string& name) {
  return subject_of(name, [](const Case& scene) {
    if (scene.solid) fastpath::require_solid(scene.mesh);
    return fastpath::solids::not_hidden(flagged(scene), scene.cell);
  });
}

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

class TrialSubject : public Subject {
 public:
  TrialSubject(std::string name, std::unique_ptr<Trial> trial) : name_(std::move(name)), trial_(std::move(trial)) {}
  Answer answer(const Case&) const override { throw NoAnswer(name_ + " is asked about no cell"); }
  std::string name() const override { return name_; }
  const Trial* trial() const override { return trial_.get(); }

 private:
  std::string name_;
  std::unique_ptr<Trial> trial_;
};

}  // namespace

std::unique_ptr<Subject> subject_of(std::string name, std::unique_ptr<Trial> trial) {
  return std::make_unique<TrialSubject>(std::move(name), std::move(trial));
}

std::unique_ptr<Subject> subject_of(std::string name, std::function<std::vector<std::uint32_t>(const Case&)> pvs) {
  return std::make_unique<FunctionSubject>(std::move(name), false, [pvs = std::move(pvs)](const Case& scene) {
    return Answer{pvs(scene), std::nullopt, std::nullopt};
  });
}

std::unique_ptr<Subject> make_subject(const std::string& text) {
  if (is_program(text)) return std::make_unique<CommandSubject>(text);
  if (text == "reference") return reference_subject(text);
  if (cases_for_a_comparison(text)) return fast_subject(text);
  if (text == "subdivided") return refined_subject(text, validate::Refinement::cells);
  if (text == "backprojected") return refined_subject(text, validate::Refinement::backprojection);
  if (text == "fast:subdivided") return refined_fast_subject(text, fastpath::RefineBy::cells);
  if (text == "solids") return solids_subject(text);
  if (text == "maps") return subject_of(text, make_maps_trial());
  if (text == "motion") return subject_of(text, make_motion_trial());
  if (text == "deltas") return subject_of(text, make_deltas_trial());
  if (text == "bakes") return subject_of(text, make_bakes_trial());
  if (text == "streams") return subject_of(text, make_streams_trial());
  if (const auto lines = lines_of_each_level(text)) return subject_of(text, make_levels_trial(*lines));
  assert(text == "fast:backprojected");
  return refined_fast_subject(text, fastpath::RefineBy::backprojection);
}

}  // namespace clues::fuzz

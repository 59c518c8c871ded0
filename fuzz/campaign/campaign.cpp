#include "fuzz/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "fuzz/campaign/generators.h"
#include "fuzz/campaign/pair_seeker.h"
#include "fuzz/findings/dials.h"
#include "fuzz/findings/store_content.h"
#include "fuzz/oracles/oracle.h"
#include "fuzz/oracles/rules.h"
#include "fuzz/shrinking/finding_folder.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/messages/shell_word.h"
#include "validate/processes/workers.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;
using scene::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look_up{200};
// In so many cases what a campaign must meet comes up, dials included.
constexpr std::uint64_t rounds_to_judge = 4, least_to_judge = 100;

std::string plan_of(const CampaignOptions& options, const std::vector<NamedGenerator>& generators,
                    const std::vector<std::string>& oracles, const Subject& subject, bool dials, std::uint64_t shard,
                    std::uint64_t shards) {
  json plan{
      {"seed", options.seed}, {"first", options.first}, {"subject", subject.name()}, {"scenes", options.given.hashes}};
  if (dials) plan["dials"] = true;
  if (options.seek_pairs) plan["seeks"] = "pairs";
  if (shards > 1) plan["shard"] = fmt::format("{}/{}", shard + 1, shards);
  for (const auto& g : generators) plan["generators"].push_back(g.name);
  for (const auto& name : oracles) plan["oracles"].push_back(name);
  return plan.dump();
}

// Where the next case can be chosen by what the cases before it met.
void require_seekable(const CampaignOptions& options, const Subject& subject) {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::bad_argument, "--seek-pairs: " + why); };
  if (options.shards > 1 || !options.merged.empty())
    refuse(
        "which case comes next depends on all that were judged, which shards cannot know; leave out --shard and "
        "--merge, or use mpirun");
  if (cases_for_a_comparison(subject.name()).value_or(1) > 1)
    refuse("the rules that a case meets are known where it is compared; leave out --agreement");
  if (subject.trial()) refuse("no map says which rules a case of the subject " + subject.name() + " meets");
}

// What the cases are, and how one is judged.
class Cases {
 public:
  Cases(const CampaignOptions& options, const Subject& subject)
      : options_(options), subject_(subject), trial_(subject.trial()) {
    if (options.seek_pairs) require_seekable(options, subject);
    if (!trial_) {
      generators_ = generators_named(options.generators, options.given);
      oracles_ = oracles_named(options.oracles);
      return;
    }
    if (!options.given.paths.empty() && !trial_->takes_levels())
      throw Error(ErrorCode::bad_argument, "--scenes: the subject " + subject.name() + " takes none");
    checks_ = checks_named(*trial_, options.oracles);
    generators_ = generators_named(*trial_, options.generators, checks_, options.given);
  }

  std::string plan(std::uint64_t shard, std::uint64_t shards) const {
    std::vector<std::string> names;
    for (const Oracle* o : oracles_) names.emplace_back(o->name());
    for (const auto& check : checks_) names.emplace_back(check.name);
    return plan_of(options_, generators_, names, subject_, turns_dials(), shard, shards);
  }

  Case make(std::uint64_t number) const {
    const auto& g = generators_[number % generators_.size()];
    Case made = g.make(options_.seed, options_.first + number / generators_.size());
    return turns_dials() ? with_dials(std::move(made), subject_.takes_dials()) : made;
  }

  std::string judged(std::uint64_t number) const {
    return to_json_text(trial_ ? judge_case(make(number), *trial_, checks_)
                               : judge_case(make(number), subject_, oracles_));
  }

  const std::vector<NamedGenerator>& generators() const { return generators_; }

  // Anti-vacuity: the counters of what a campaign with these generators and oracles must have met.
  std::vector<std::string> needed() const {
    std::vector<std::string> needed;
    if (!trial_)
      needed = {"triangles visible", "triangles hidden", "triangles partly visible",    "wedges SV-ME",
                "wedges SE-ME",      "wedges SE-MV",     "compound silhouette vertices"};
    for (const auto& g : generators_) needed.push_back("cases of " + g.name);
    for (const Oracle* o : oracles_) {
      for (const char* name : o->needs()) needed.emplace_back(name);
    }
    for (const auto& check : checks_) {
      const bool looks = std::any_of(generators_.begin(), generators_.end(),
                                     [&](const auto& g) { return trial_->looks_at(check.name, g.name); });
      if (looks) needed.insert(needed.end(), check.needs.begin(), check.needs.end());
    }
    for (const NamedDial& d : all_dials()) {
      if (turns_dials() && (d.of == NamedDial::Of::scene || subject_.takes_dials()))
        needed.push_back(std::string("dial ") + d.name);
    }
    return needed;
  }

 private:
  bool turns_dials() const { return options_.dials && !trial_; }

  const CampaignOptions& options_;
  const Subject& subject_;
  const Trial* trial_;
  std::vector<NamedGenerator> generators_;
  std::vector<const Oracle*> oracles_;  // of a subject that answers,
  std::vector<Trial::Check> checks_;    // or of a trial
};

class Campaign {
 public:
  Campaign(const CampaignOptions& options, const Subject& subject)
      : options_(options),
        subject_(subject),
        cases_(options, subject),
        file_(made(options.out) / "findings.sqlite"),
        store_(with_shards(), cases_.plan(options.shard, options.shards)) {
    if (!options.seek_pairs) return;
    seeker_.emplace(cases_.generators().size(), [this](std::uint64_t number) { return cases_.make(number).dials; });
    const auto sought = store_.sought();
    if (sought.size() != store_.cases_done())
      throw Error(ErrorCode::malformed, fmt::format("{}: has done {} cases and chosen {}; the store was changed",
                                                    file_.string(), store_.cases_done(), sought.size()));
    seeker_->resume(sought, store_.counters());
  }

  CampaignSummary run() {
    const auto begin = Clock::now();
    const std::uint64_t before = store_.cases_done();
    for (const auto& f : store_.findings()) signatures_.insert(f.finding.signature());
    run_cases();
    CampaignSummary summary;
    summary.is_shard = options_.shards > 1;
    summary.is_trial = subject_.trial() != nullptr;
    summary.subject = subject_.name();
    summary.seconds_now = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!stopped() && !summary.is_shard) save_findings();
    summary.interrupted = stopped();
    summary.cases = ours_below(store_.cases_done());
    summary.cases_now = summary.cases - ours_below(before);
    summary.counters = store_.counters();
    summary.findings = store_.findings();
    summary.contradictions = store_.contradictions();
    for (const auto& pair : rules_met(summary.counters).wrongly_impossible)
      summary.contradictions.push_back("rules that exclude each other were met in one map: " + pair);
    summary.never_occurred = never_occurred(summary.counters);
    summary.generators = cases_.generators().size();
    summary.enough = std::max(rounds_to_judge * cases_.generators().size(), least_to_judge);
    summary.judged = !summary.is_shard && (options_.require_coverage || summary.cases >= summary.enough);
    store_.finish();
    return summary;
  }

 private:
  static const fs::path& made(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder, error))
      throw scene::Error(scene::ErrorCode::file_unwritable, folder.string() + ": cannot make this folder");
    return folder;
  }

  bool stopped() const { return options_.stop && options_.stop->load(); }
  bool enough_errors() const { return options_.errors > 0 && signatures_.size() >= options_.errors; }

  // How many of the cases below this number are of this shard.
  std::uint64_t ours_below(std::uint64_t number) const {
    return (number + options_.shards - 1 - options_.shard) / options_.shards;
  }

  // The store, which holds what all shards hold before anything else is done with it.
  const fs::path& with_shards() const {
    if (options_.merged.empty()) return file_;
    std::vector<StoreContent> shards(options_.merged.size());
    for (const auto& folder : options_.merged) {
      auto content = read_store(folder / "findings.sqlite");
      std::size_t i = 0;
      while (i < shards.size() && content.plan != cases_.plan(i, shards.size())) ++i;
      if (i == shards.size() || !shards[i].plan.empty())
        throw Error(ErrorCode::bad_argument,
                    fmt::format("--merge {}: is {}; name the folders of all shards of this campaign, each once",
                                folder.string(),
                                i < shards.size() ? std::string("a shard that was named already")
                                                  : fmt::format("no shard of {} of this campaign: {}", shards.size(),
                                                                scene::printable(content.plan, 400))));
      shards[i] = std::move(content);
    }
    for (std::size_t i = 0; i < shards.size(); ++i) {
      if (shards[i].cases_done == shards[0].cases_done) continue;
      throw Error(ErrorCode::bad_argument,
                  fmt::format("--merge: shard 1/{} has done the cases below {}, and shard {}/{} those below {}; repeat "
                              "their commands with the same --cases",
                              shards.size(), shards[0].cases_done, i + 1, shards.size(), shards[i].cases_done));
    }
    const auto all = merged(shards, cases_.plan(0, 1));
    // What is there already may be further: its findings have been shrunk.
    if (Store(file_, all.plan).cases_done() < all.cases_done) write_store(file_, all);
    return file_;
  }

  // Cases have places in the order of the campaign, of which this shard has every one, counted from 0.
  bool knows(std::uint64_t place) const { return !seeker_ || seeker_->knows(place); }
  std::uint64_t number_at(std::uint64_t place) const {
    return seeker_ ? seeker_->number(place) : place * options_.shards + options_.shard;
  }
  // What the store has done when all cases before this place are.
  std::uint64_t done_before(std::uint64_t place, std::uint64_t last) const {
    return seeker_ ? place : std::min(number_at(place), last);
  }

  void run_cases() {
    const std::uint64_t last = options_.cases.value_or(UINT64_MAX), done = store_.cases_done();
    const std::uint64_t places = options_.cases ? ours_below(last) : UINT64_MAX;
    std::uint64_t next = ours_below(done);
    const auto end = options_.time ? Clock::now() + *options_.time : Clock::time_point::max();
    if (done >= last || enough_errors()) return;
    const auto workers = new_pool();
    std::uint64_t expected = next;  // the place of the case to go into the store next
    std::map<std::uint64_t, Outcome> early;
    std::vector<Judged> block;
    const auto commit = [&] {
      const std::uint64_t below = done_before(expected, last);
      if (!block.empty() || below > store_.cases_done()) store_.commit(block, below);
      block.clear();
    };
    while (true) {
      while (workers->idle() && next < places && knows(next) && !stopped() && Clock::now() < end)
        workers->start(number_at(next++));
      if (workers->empty()) break;
      const auto reply = workers->wait(look_up);
      if (!reply) continue;
      early[reply->task] = reply->finished ? outcome_from_json_text(reply->text) : lost(reply->task, reply->text);
      while (expected < next) {
        const auto at = early.find(number_at(expected));
        if (at == early.end()) break;
        for (const Finding& f : at->second.findings) signatures_.insert(f.signature());
        block.push_back({at->first, std::move(at->second)});
        early.erase(at);
        if (seeker_) block.back().new_pairs = seeker_->tell(block.back().outcome.counters);
        ++expected;
        if (enough_errors()) return commit();
        if (block.size() >= options_.block) commit();
      }
      if (options_.progress)
        options_.progress(fmt::format("cases, {} findings", signatures_.size()), expected, std::min(places, next));
    }
    commit();
  }

  std::unique_ptr<validate::WorkPool> new_pool() const {
    const auto judged = [this](std::uint64_t n) { return cases_.judged(n); };
    if (options_.pool) return options_.pool(cases_.plan(options_.shard, options_.shards), judged);
    return std::make_unique<validate::Workers>(options_.jobs, judged, options_.time_for_one);
  }

  Outcome lost(std::uint64_t number, const std::string& failure) const {
    Outcome outcome;
    Finding f;
    f.oracle = "subject";
    f.verdict = failure.starts_with("no end") ? "no-end/answer" : "crash/answer";
    f.where = cases_.make(number);
    f.explanation = "the process that worked on this case: " + failure;
    outcome.counters["cases of " + f.where.generator] = 1;
    outcome.findings.push_back(std::move(f));
    return outcome;
  }

  // Shrinks, verifies and saves what has no folder yet.
  void save_findings() {
    std::vector<StoredFinding> open = store_.findings();
    // A folder that was taken away, or lost in a copy, is made again.
    std::erase_if(open, [&](const StoredFinding& f) { return f.folder && holds_a_finding(options_.out / *f.folder); });
    if (open.empty()) return;
    validate::Workers workers(
        options_.jobs, [&](std::uint64_t i) { return shrunk_text(open[i].finding); },
        std::chrono::ceil<std::chrono::seconds>(2 * options_.shrink.time) + options_.time_for_one);
    std::map<std::uint64_t, validate::WorkerReply> replies;
    for (std::uint64_t next = 0; replies.size() < open.size() && !stopped();) {
      while (workers.idle() && next < open.size()) workers.start(next++);
      if (auto reply = workers.wait(look_up)) replies[reply->task] = std::move(*reply);
      if (options_.progress) options_.progress("findings shrunk", replies.size(), open.size());
    }
    for (const auto& [i, reply] : replies) save(open[i], reply);
  }

  std::string shrunk_text(const Finding& f) const {
    json out;
    Shrunk shrunk{f, 0};
    const bool repeatable = f.verdict != "crash/answer" && f.verdict != "no-end/answer";
    if (repeatable) shrunk = shrink(f, subject_, options_.shrink);
    out["finding"] = to_json_text(shrunk.finding);
    out["steps"] = shrunk.steps;
    out["flaw"] = repeatable ? flaw_now(shrunk.finding) : "";
    return out.dump();
  }

  std::string flaw_now(const Finding& f) const {
    try {
      return flaw_of(f, subject_);
    } catch (const NoAnswer& error) {
      return std::string("the subject gives no answer: ") + error.what();
    }
  }

  void save(const StoredFinding& stored, const validate::WorkerReply& reply) {
    SavedFinding saved{stored.finding, stored.finding, subject_.name(), options_.given.paths, 0};
    if (reply.finished) {
      const json in = scene::parse_json(reply.text, "a process of clues fuzz");
      saved.finding = finding_from_json_text(in.at("finding").get<std::string>());
      saved.steps = in.at("steps").get<std::uint64_t>();
      const auto flaw = in.at("flaw").get<std::string>();
      if (!flaw.empty()) store_.contradict(stored, stored.finding.signature() + ": does not replay: " + flaw);
    }
    const std::string name = free_name(stored);
    save_finding(saved, options_.out / name);
    store_.saved(stored.id, name);
  }

  // Where something of this name lies that we did not make, or that is of another finding, a number is added.
  std::string free_name(const StoredFinding& stored) const {
    const std::string name = folder_name(stored.finding);
    const auto all = store_.findings();
    for (int i = 1;; ++i) {
      std::string numbered = i == 1 ? name : fmt::format("{}-{}", name, i);
      const bool taken = std::any_of(all.begin(), all.end(),
                                     [&](const StoredFinding& f) { return f.id != stored.id && f.folder == numbered; });
      if (!taken && is_free_for_a_finding(options_.out / numbered)) return numbered;
    }
  }

  std::vector<std::string> never_occurred(const Counters& counters) const {
    std::vector<std::string> missing;
    for (const auto& name : cases_.needed()) {
      const auto at = counters.find(name);
      if (at == counters.end() || at->second == 0) missing.push_back(name);
    }
    return missing;
  }

  const CampaignOptions& options_;
  const Subject& subject_;
  const Cases cases_;
  const fs::path file_;
  Store store_;
  std::optional<PairSeeker> seeker_;
  std::set<std::string> signatures_;
};

}  // namespace

int CampaignSummary::exit_code() const {
  if (!contradictions.empty()) return 4;
  if (!findings.empty()) return 1;
  return interrupted || (judged && !never_occurred.empty()) ? 3 : 0;
}

CampaignSummary run_campaign(const CampaignOptions& options, const Subject& subject) {
  return Campaign(options, subject).run();
}

void serve_campaign(const CampaignOptions& options, const Subject& subject, const validate::Serve& serve) {
  const Cases cases(options, subject);
  serve(cases.plan(options.shard, options.shards), [&](std::uint64_t number) { return cases.judged(number); });
}

namespace {

std::string rules_text(const Counters& counters) {
  const RulesMet met = rules_met(counters);
  std::string text = fmt::format("{:>14}  of {} pairs of rules met in one case; {} more exclude each other\n",
                                 met.pairs, met.all_pairs, met.impossible);
  for (const auto& rule : met.never) text += fmt::format("{:>14}  met: rule {}\n", "never", rule);
  for (const auto& pair : met.apart) text += fmt::format("{:>14}  met together: {}\n", "never", pair);
  return text;
}

// What a run says that is too short to be judged, or is a part of one.
std::string short_line(const CampaignSummary& s) {
  if (s.is_shard)
    return fmt::format("{} cases of this shard; {} different findings{}\n", s.cases, s.findings.size(),
                       s.interrupted ? "; interrupted: the same command goes on"
                                     : "; --merge brings shards together, and shrinks what they found");
  const std::size_t count = s.findings.size();
  const std::string found =
      count == 0 ? "nothing found yet" : fmt::format("{} finding{}", count, count == 1 ? "" : "s");
  std::string more = fmt::format("go on to --cases {}", s.enough);
  if (s.cases_now > 0) {
    const double left = static_cast<double>(s.enough - s.cases) * s.seconds_now / static_cast<double>(s.cases_now);
    more = fmt::format("run {:.0f} min or more", std::max(1.0, std::ceil(left / 60)));
  }
  return fmt::format("{} case{} of {} generator{} {}; {}; {} to be told what was covered{}\n", s.cases,
                     s.cases == 1 ? "" : "s", s.generators, s.generators == 1 ? "'s" : "s'", s.enough, found, more,
                     s.interrupted ? "; interrupted: the same command goes on" : "");
}

}  // namespace

std::string to_text(const CampaignSummary& s, const fs::path& out) {
  std::string text;
  for (const auto& f : s.findings) {
    text +=
        fmt::format("FINDING {} (case {}: {} {} of seed {}; {} times)\n  {}\n", scene::printable(f.finding.signature()),
                    f.case_number, scene::printable(f.finding.where.generator), f.finding.where.index,
                    f.finding.where.seed, f.occurrences, scene::printable(f.finding.explanation));
    if (const auto& w = f.finding.witness) {
      text += fmt::format("  triangle {} ({} side), witness ({}, {}, {}) - ({}, {}, {})\n", w->triangle,
                          w->front ? "front" : "back", w->v[0], w->v[1], w->v[2], w->p[0], w->p[1], w->p[2]);
    }
    text += f.folder     ? fmt::format("  repeat: clues replay {}{}\n", scene::shell_word((out / *f.folder).string()),
                                   is_program(s.subject) ? " --run-subject" : "")
            : s.is_shard ? ""
                         : "  not shrunk yet: run the same command again\n";
  }
  for (const auto& c : s.contradictions) text += "CONTRADICTION " + scene::printable(c) + "\n";
  if (!s.judged) return text + short_line(s);
  for (const auto& [name, value] : s.counters) {
    if (!is_a_pair(name)) text += fmt::format("{:>14}  {}\n", value, scene::printable(name));
  }
  if (!s.is_trial) text += rules_text(s.counters);
  for (const auto& name : s.never_occurred) text += "NEVER OCCURRED: " + scene::printable(name) + "\n";
  text += fmt::format("{} cases, {} of them in this run; {} different findings{}\n", s.cases, s.cases_now,
                      s.findings.size(), s.interrupted ? "; interrupted: the same command goes on" : "");
  if (!s.never_occurred.empty())
    text += "The campaign is vacuous: it did not meet all that it is meant to test. Give it more cases.\n";
  return text;
}

}  // namespace clues::fuzz

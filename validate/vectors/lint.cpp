// Reads all files first, then proves the selected cases in child processes, then writes.
#include "validate/vectors/lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "scene/files/atomic_file.h"
#include "scene/formats/file_bytes.h"
#include "scene/json_reader.h"
#include "scene/messages/error.h"
#include "scene/result.h"
#include "validate/processes/workers.h"
#include "validate/vectors/reader.h"
#include "validate/vectors/writer.h"

namespace clues::validate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using scene::Error;

// What a child says about one case.
struct CaseAnswer {
  CaseProofs proofs;
  std::string derived;  // Expectation as JSON text, when one was asked for and found
  std::string why;      // why none was found
};

std::string pack(const CaseAnswer& answer) {
  json findings = json::array();
  for (const auto& f : answer.proofs.findings) findings.push_back({f.field, f.message, f.contradiction});
  const auto& p = answer.proofs;
  return json{{"findings", findings},
              {"counts", {p.cell_contacts, p.witnesses, p.umbra_by_map, p.umbra_exhaustive, p.oracle_points}},
              {"derived", answer.derived},
              {"why", answer.why}}
      .dump();
}

CaseAnswer unpack(const std::string& text) {
  const json value = scene::parse_json(text, "a process of clues lint");
  CaseAnswer answer;
  for (const auto& f : value["findings"]) answer.proofs.findings.push_back({f[0], f[1], f[2]});
  const auto& counts = value["counts"];
  auto& p = answer.proofs;
  p.cell_contacts = counts[0];
  p.witnesses = counts[1];
  p.umbra_by_map = counts[2];
  p.umbra_exhaustive = counts[3];
  p.oracle_points = counts[4];
  answer.derived = value["derived"];
  answer.why = value["why"];
  return answer;
}

CaseAnswer look_at(const VectorCase& c, bool derive_when_wrong) {
  CaseAnswer answer;
  if (c.expect) answer.proofs = prove_case(c);
  if (!derive_when_wrong || (c.expect && answer.proofs.findings.empty())) return answer;
  if (const auto derived = derive_expectation(c, answer.why)) answer.derived = to_json_text(*derived);
  return answer;
}

class Linter {
 public:
  Linter(const fs::path& folder, const LintOptions& options) : folder_(folder), options_(options) {}

  LintReport run() {
    read_files();
    read_index();
    select();
    prove();
    check_text();
    check_ids();
    std::stable_sort(report_.findings.begin(), report_.findings.end(),
                     [](const auto& a, const auto& b) { return a.file < b.file; });
    return std::move(report_);
  }

  void serve(const Serve& serve) {
    read_files();
    select();
    serve(plan(), work());
  }

 private:
  struct File {
    fs::path path;
    std::string bytes;
    VectorFile content;
  };

  void complain(const std::string& file, const std::string& case_id, const std::string& field,
                const std::string& message, LintKind kind = LintKind::wrong) {
    report_.findings.push_back({kind, file, case_id, field, message});
  }

  void read_files() {
    for (const auto& path : vector_files(folder_)) {
      ++report_.files;
      try {
        File file{path, scene::read_file_bytes(path), {}};
        file.content = parse_vector_file(file.bytes, path.string(), true);
        report_.cases += file.content.cases.size();
        files_.push_back(std::move(file));
      } catch (const Error& e) {
        unreadable_ = true;
        complain(path.string(), "", "", e.what(), LintKind::malformed);
      }
    }
  }

  void read_index() {
    const auto path = folder_ / "index.json";
    if (!fs::exists(path)) {
      if (!options_.write) complain(path.string(), "", "", "there is no index", LintKind::malformed);
      return;
    }
    try {
      index_ = read_vector_index(folder_);
      index_bytes_ = scene::read_file_bytes(path);
    } catch (const Error& e) {
      unreadable_ = true;
      complain(path.string(), "", "", e.what(), LintKind::malformed);
    }
  }

  void select() {
    for (auto& file : files_) {
      for (auto& c : file.content.cases) {
        if (matches_glob(c.id, options_.glob)) selected_.emplace_back(&file, &c);
      }
    }
    report_.selected = selected_.size();
  }

  std::string plan() const {
    std::string text = "clues lint\n" + options_.glob + (options_.write ? "\nwrite\n" : "\n");
    for (const auto& file : files_) text += scene::sha256_of(file.bytes) + "\n";
    return text;
  }
  Work work() const {
    return [this](std::uint64_t i) { return pack(look_at(*selected_.at(i).second, options_.write)); };
  }

  void prove() {
    if (selected_.empty()) return;
    const auto jobs = std::min<std::size_t>(selected_.size(), static_cast<std::size_t>(std::max(options_.jobs, 1)));
    const auto pool = options_.pool ? options_.pool(plan(), work())
                                    : std::make_unique<Workers>(static_cast<int>(jobs), work(), std::nullopt);
    const auto answers = replies_of(*pool, selected_.size(), [&](std::size_t done) {
      if (options_.progress) options_.progress(done, selected_.size());
    });
    for (std::size_t i = 0; i < selected_.size(); ++i) take(*selected_[i].first, *selected_[i].second, answers[i]);
  }

  void take(const File& file, VectorCase& c, const WorkerReply& raw) {
    if (!raw.finished) {
      return complain(file.path.string(), c.id, "", "could not be proved: " + raw.text,
                      raw.signal == SIGKILL ? LintKind::unfinished : LintKind::contradiction);
    }
    const CaseAnswer answer = unpack(raw.text);
    auto& sums = report_.proofs;
    sums.cell_contacts += answer.proofs.cell_contacts;
    sums.witnesses += answer.proofs.witnesses;
    sums.umbra_by_map += answer.proofs.umbra_by_map;
    sums.umbra_exhaustive += answer.proofs.umbra_exhaustive;
    sums.oracle_points += answer.proofs.oracle_points;
    const bool contradicts = std::any_of(answer.proofs.findings.begin(), answer.proofs.findings.end(),
                                         [](const CaseFinding& f) { return f.contradiction; });
    bool settled = c.expect && answer.proofs.findings.empty();
    if (!answer.derived.empty() && !contradicts) settled = put(file, c, answer.derived);
    if (settled) {
      ++report_.proved;
      return;
    }
    if (!answer.why.empty()) why_missing_[c.id] = ": " + answer.why;
    for (const auto& f : answer.proofs.findings) {
      complain(file.path.string(), c.id, f.field, f.message,
               f.contradiction ? LintKind::contradiction : LintKind::wrong);
    }
  }

  // Whether the derived expectation now stands in the case.
  bool put(const File& file, VectorCase& c, const std::string& derived) {
    const std::string place = file.path.string() + ": case " + c.id + ": ";
    if (!c.expect) {
      report_.changes.push_back(place + "expect filled in");
    } else {
      report_.changes.push_back(fmt::format("{}expect {}:\n- {}+ {}", place,
                                            options_.accept ? "replaced" : "would be replaced with --accept",
                                            to_json_text(*c.expect), derived));
      if (!options_.accept) return false;
    }
    c.expect = parse_expectation(derived, c);
    return true;
  }

  void save(const fs::path& path, const std::string& text) {
    scene::write_file_atomically(path, text);
    report_.written.push_back(path.string());
  }

  void check_text() {
    for (const auto& file : files_) {
      const std::string text = to_json_text(file.content);
      if (text == file.bytes) continue;
      if (options_.write) {
        save(file.path, text);
      } else {
        complain(file.path.string(), "", "", "is not in the canonical form; `clues lint --write` writes it");
      }
    }
  }

  void check_ids() {
    const std::string name = (folder_ / "index.json").string();
    VectorIndex now;
    std::map<std::string, std::string> where;
    for (const auto& file : files_) {
      for (const auto& c : file.content.cases) {
        if (!c.expect) complain(file.path.string(), c.id, "expect", "is missing" + why_missing_[c.id]);
        const auto [other, is_new] = where.emplace(c.id, file.path.string());
        if (!is_new) complain(file.path.string(), c.id, "id", "is also in " + other->second);
        const auto entry = index_.cases.find(c.id);
        if (entry == index_.cases.end() && !options_.write)
          complain(file.path.string(), c.id, "id", "is not in index.json");
        if (entry != index_.cases.end() && entry->second.withdrawn) {
          complain(file.path.string(), c.id, "id", "is withdrawn in index.json; ids are not used again");
        }
        if (entry != index_.cases.end() && entry->second.topic != c.topic) {
          complain(file.path.string(), c.id, "topic",
                   "index.json has it in " + entry->second.topic + "; cases stay in their topic");
        }
        now.cases.emplace(c.id, IndexEntry{c.topic, false, ""});
      }
    }
    if (unreadable_) return;  // what is missing may be in there
    for (const auto& [id, entry] : index_.cases) {
      if (!entry.withdrawn && !now.cases.contains(id)) {
        complain(name, id, "", "has vanished from the files; put it back, or mark it \"withdrawn\" with the reason");
      }
      now.cases.insert_or_assign(id, entry);
    }
    for (const auto& [id, entry] : now.cases) {
      ++(entry.withdrawn ? now.withdrawn : now.active);
      if (!entry.withdrawn) ++now.topics[entry.topic];
    }
    const std::string text = to_json_text(now);
    if (text == index_bytes_) return;
    if (options_.write) {
      save(folder_ / "index.json", text);
    } else if (!index_bytes_.empty()) {
      complain(name, "", "",
               index_.active != now.active || index_.withdrawn != now.withdrawn || index_.topics != now.topics
                   ? "the counts do not agree with the cases; `clues lint --write` counts anew"
                   : "is not up to date or not in the canonical form; `clues lint --write` writes it");
    }
  }

  fs::path folder_;
  const LintOptions& options_;
  std::vector<File> files_;
  std::vector<std::pair<File*, VectorCase*>> selected_;
  std::map<std::string, std::string> why_missing_;  // by case id
  VectorIndex index_;
  std::string index_bytes_;
  bool unreadable_ = false;
  LintReport report_;
};

const char* to_word(LintKind kind) {
  switch (kind) {
    case LintKind::malformed:
      return "malformed";
    case LintKind::wrong:
      return "wrong";
    case LintKind::unfinished:
      return "unfinished";
    case LintKind::contradiction:
      return "contradiction";
  }
  return "?";
}

}  // namespace

LintReport lint_suite(const fs::path& folder, const LintOptions& options) { return Linter(folder, options).run(); }

void serve_lint(const fs::path& folder, const LintOptions& options, const Serve& serve) {
  Linter(folder, options).serve(serve);
}

std::string to_text(const LintReport& report) {
  std::string text;
  for (const auto& change : report.changes) text += change + "\n";
  for (const auto& path : report.written) text += path + ": written\n";
  for (const auto& f : report.findings) {
    if (f.kind == LintKind::malformed) {  // an Error names its place itself
      text += (f.message.starts_with(f.file) ? "" : f.file + ": ") + f.message + "\n";
      continue;
    }
    text += f.file + ": ";
    if (!f.case_id.empty()) text += "case " + f.case_id + ": ";
    if (!f.field.empty()) text += f.field + ": ";
    text += (f.kind == LintKind::contradiction ? "CONTRADICTION: " : "") + f.message + "\n";
  }
  const auto& p = report.proofs;
  text += fmt::format(
      "{} files, {} cases; {} of {} proved: {} witnesses, {} contacts with the cell, {} umbrae by the map, {} "
      "exhaustively; "
      "the oracle was asked {} times\n",
      report.files, report.cases, report.proved, report.selected, p.witnesses, p.cell_contacts, p.umbra_by_map,
      p.umbra_exhaustive, p.oracle_points);
  text += report.findings.empty() ? "no findings\n" : fmt::format("{} findings\n", report.findings.size());
  return text;
}

std::string to_json_text(const LintReport& report) {
  json findings = json::array();
  for (const auto& f : report.findings) {
    findings.push_back(
        {{"kind", to_word(f.kind)}, {"file", f.file}, {"case", f.case_id}, {"field", f.field}, {"message", f.message}});
  }
  const auto& p = report.proofs;
  return json{{"format", "clues-lint/1"},
              {"findings", findings},
              {"changes", report.changes},
              {"written", report.written},
              {"files", report.files},
              {"cases", report.cases},
              {"selected", report.selected},
              {"proved", report.proved},
              {"proofs",
               {{"witnesses", p.witnesses},
                {"meets_cell", p.cell_contacts},
                {"umbra_first_order_map", p.umbra_by_map},
                {"umbra_exhaustive", p.umbra_exhaustive},
                {"oracle_points", p.oracle_points}}}}
             .dump(2) +
         "\n";
}

}  // namespace clues::validate

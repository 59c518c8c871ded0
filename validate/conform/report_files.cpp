// A run as JSON and as JUnit XML.
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/messages/printable.h"
#include "validate/conform/report.h"
#include "validate/verdicts/area.h"

namespace clues::validate {
namespace {

using Json = nlohmann::json;

Json to_json(const MustBeVisible& proof) {
  if (proof.meets_cell) return {{"triangle", proof.triangle}, {"meets_cell", true}};
  return {{"triangle", proof.triangle}, {"side", proof.front ? "front" : "back"}, {"v", proof.v}, {"p", proof.p}};
}

Json to_json(const std::optional<double>& ratio) { return ratio ? Json(*ratio) : Json(); }

Json to_json(const Run& run, const CaseResult& result) {
  Json json = {{"id", result.test->id}, {"topic", result.test->topic}, {"outcome", to_string(result.outcome)}};
  if (const auto* entry = run.expectation(result)) {
    json["expected_failure"] = {{"issue", entry->issue}, {"date", entry->date}};
  }
  if (result.has_pvs()) {
    Json missed = Json::array();
    for (const auto* proof : result.missed) missed.push_back(to_json(*proof));
    json["missed"] = missed;
    json["extra"] = result.extra;
    json["out_of_first_order"] = result.out_of_first_order;
    json["visible_exact"] = result.test->expect->must_be_visible.size();
    const auto area = [&](const auto& triangles, const auto& id_of) {
      double sum = 0;
      for (const auto& t : triangles) sum += area_estimate(result.test->mesh, id_of(t));
      return sum;
    };
    const double visible = area(result.test->expect->must_be_visible, [](const auto& proof) { return proof.triangle; });
    if (visible > 0) {  // Bittner et al. 2005 in area, rounded (docs/formats.md)
      json["overestimate_qo_area"] = area(result.extra, [](std::uint32_t t) { return t; }) / visible;
      json["underestimate_qu_area"] = area(result.missed, [](const auto* proof) { return proof->triangle; }) / visible;
    }
  } else {
    json["message"] = result.answer.message;
    if (!result.answer.issue_url.empty()) json["issue_url"] = result.answer.issue_url;
    if (!result.answer.stderr_tail.empty()) json["stderr_tail"] = result.answer.stderr_tail;
  }
  return json;
}

Json to_json(const Tally& tally) {
  Json outcomes = Json::object();
  for (std::size_t i = 0; i < outcome_count; ++i) outcomes[to_string(static_cast<Outcome>(i))] = tally.outcomes[i];
  return {{"cases", tally.cases},
          {"outcomes", outcomes},
          {"triangles", {{"visible_exact", tally.exact}, {"extra", tally.extra}, {"missed", tally.missed}}},
          {"overestimate_qo", to_json(tally.over_estimate())},
          {"underestimate_qu", to_json(tally.under_estimate())},
          {"within_first_order", tally.within_first_order},
          {"looser_than_first_order", tally.looser}};
}

}  // namespace

std::string to_json_text(const Run& run, const ReportContext& context) {
  Json cases = Json::array(), topics = Json::object();
  for (const auto& result : run.results) cases.push_back(to_json(run, result));
  for (const auto& [topic, tally] : run.topics) topics[topic] = to_json(tally);
  const Json json = {{"format", "clues-conformance/1"},
                     {"clues", context.version},
                     {"suite", context.suite},
                     {"subject", context.subject},
                     {"implementation",
                      {{"name", context.about.name},
                       {"version", context.about.version},
                       {"language", context.about.language},
                       {"homepage", context.about.homepage},
                       {"issues", context.about.issues}}},
                     {"repeat", context.repeat},
                     {"total", to_json(run.total)},
                     {"topics", topics},
                     {"cases", cases},
                     {"executed", run.executed()},
                     {"problems", run.problems()},
                     {"not_reached", run.not_reached},
                     {"suite_flaws", run.flaws}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// XML 1.0 knows no control characters, not even escaped, and no bytes that are no UTF-8: printable_lines().
std::string to_junit_text(const Run& run, const ReportContext& context) {
  namespace pt = boost::property_tree;
  pt::ptree suites;
  suites.put("<xmlattr>.name", scene::printable_lines(context.subject));
  for (const auto& [topic, tally] : run.topics) {
    pt::ptree suite;
    std::uint64_t failures = 0, errors = 0, skipped = 0;
    pt::ptree cases;
    for (const auto& result : run.results) {
      if (result.test->topic != topic) continue;
      pt::ptree item;
      item.put("<xmlattr>.classname", topic);
      item.put("<xmlattr>.name", result.test->id);
      const char* verdict = nullptr;
      if (run.is_problem(result)) {
        verdict = "failure";
        ++failures;
      } else if (is_unanswered(result.outcome)) {
        verdict = "error";
        ++errors;
      } else if (!is_executed(result.outcome) || run.is_expected(result)) {
        verdict = "skipped";
        ++skipped;
      }
      if (verdict != nullptr) {
        pt::ptree detail;
        const std::string prefix = run.is_expected(result) ? "expected to fail: " : "";
        detail.put("<xmlattr>.message",
                   scene::printable_lines(prefix + to_string(result.outcome) + ": " + describe(run, result)));
        if (verdict != std::string("skipped")) {
          detail.put("<xmlattr>.type", to_string(result.outcome));
          detail.put_value(
              scene::printable_lines("repeat: " + context.repeat + " --case " + result.test->id +
                                     (result.answer.stderr_tail.empty() ? "" : "\n" + result.answer.stderr_tail)));
        }
        item.add_child(verdict, detail);
      }
      cases.add_child("testcase", item);
    }
    suite.put("<xmlattr>.name", topic);
    suite.put("<xmlattr>.tests", tally.cases);
    suite.put("<xmlattr>.failures", failures);
    suite.put("<xmlattr>.errors", errors);
    suite.put("<xmlattr>.skipped", skipped);
    for (auto& item : cases) suite.push_back(item);
    suites.add_child("testsuite", suite);
  }
  pt::ptree document;
  document.add_child("testsuites", suites);
  std::ostringstream out;
  pt::write_xml(out, document, pt::xml_writer_make_settings<std::string>(' ', 2));
  return out.str();
}

}  // namespace clues::validate

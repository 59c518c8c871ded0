// What the formats of the suites beside the one about visibility have in common (vectors/motion, vectors/multires): closed objects, ids, comments, and
// topics of cases. What is wrong is an Error malformed with file and case.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clues::validate {

[[noreturn]] void refuse(const std::string& where, const std::string& what);
// All fields that are required, and none that is unknown.
void check_keys(const nlohmann::json& object, const std::vector<std::string>& required,
                const std::vector<std::string>& optional, const std::string& where);
std::string text_in(const nlohmann::json& value, const std::string& where);

// The fields "id" and "comment" of a case.
std::string case_id_in(const nlohmann::json& test, const std::string& file);
std::string place_of_case(const std::string& file, const std::string& id);
std::string comment_in(const nlohmann::json& test, const std::string& where);
[[noreturn]] void refuse_draft(const std::string& where);

// Whether the schema of a folder has this title.
bool is_suite_of(const std::filesystem::path& folder, const char* format);

// An object of the format, the name of the topic and cases: one or more.
nlohmann::json topic_root_in(std::string_view text, const std::string& file, const char* format);
template <class Topic, class ReadCase>
Topic topic_in(std::string_view text, const std::string& file, const char* format, const ReadCase& read_case) {
  const nlohmann::json root = topic_root_in(text, file, format);
  Topic out{file, root["topic"].get<std::string>(), {}};
  for (const auto& value : root["cases"]) out.cases.push_back(read_case(value));
  return out;
}

// The canonical text, of the texts of its cases.
std::string topic_to_text(const char* format, const std::string& topic, const std::vector<std::string>& cases);

}  // namespace clues::validate

#include "validate/vectors/side_topic.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/json_reader.h"
#include "scene/messages/error.h"

namespace clues::validate {

using Json = nlohmann::json;

void refuse(const std::string& where, const std::string& what) {
  throw scene::Error(scene::ErrorCode::malformed, where + ": " + what);
}

void check_keys(const Json& object, const std::vector<std::string>& required, const std::vector<std::string>& optional,
                const std::string& where) {
  if (!object.is_object()) refuse(where, scene::json_excerpt(object) + " is no object");
  for (const auto& key : required) {
    if (!object.contains(key)) refuse(where, fmt::format("the field \"{}\" is missing", key));
  }
  for (const auto& item : object.items()) {
    const auto known = [&](const std::vector<std::string>& keys) {
      return std::find(keys.begin(), keys.end(), item.key()) != keys.end();
    };
    if (!known(required) && !known(optional))
      refuse(where, fmt::format("there is no field \"{}\" in this format", item.key()));
  }
}

std::string text_in(const Json& value, const std::string& where) {
  if (!value.is_string() || value.get<std::string>().empty()) refuse(where, "must be a text that is not empty");
  return value.get<std::string>();
}

std::string case_id_in(const Json& test, const std::string& file) {
  if (!test.is_object() || !test.contains("id")) refuse(file, "a case without \"id\"");
  std::string id = text_in(test["id"], file + ": id");
  if (id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
    refuse(place_of_case(file, id), "an id is made of a-z, 0-9 and -");
  return id;
}

std::string place_of_case(const std::string& file, const std::string& id) {
  return fmt::format("{}: case '{}'", file, id);
}

std::string comment_in(const Json& test, const std::string& where) {
  std::string comment = text_in(test["comment"], where + ": comment");
  if (comment.size() < 20) refuse(where, "a comment has at least 20 characters");
  return comment;
}

void refuse_draft(const std::string& where) {
  refuse(where, "the field \"expect\" is missing (`clues lint --write` fills it in)");
}

bool is_suite_of(const std::filesystem::path& folder, const char* format) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / "schema.json", ignored)) return false;
  const auto schema = scene::read_json_file(folder / "schema.json");
  return schema.is_object() && schema.value("title", "") == format;
}

Json topic_root_in(std::string_view text, const std::string& file, const char* format) {
  Json root = scene::parse_json(text, file);
  check_keys(root, {"format", "topic", "cases"}, {}, file);
  if (root["format"] != format) refuse(file, fmt::format("\"format\" must be \"{}\"", format));
  text_in(root["topic"], file + ": topic");
  if (!root["cases"].is_array() || root["cases"].empty()) refuse(file, "\"cases\" must be a list with cases");
  return root;
}

std::string topic_to_text(const char* format, const std::string& topic, const std::vector<std::string>& cases) {
  std::string out =
      fmt::format("{{\n  \"format\": \"{}\",\n  \"topic\": {},\n  \"cases\": [\n", format, Json(topic).dump());
  for (std::size_t i = 0; i < cases.size(); ++i) out.append(i == 0 ? "" : ",\n").append(cases[i]);
  return out + "\n  ]\n}\n";
}

}  // namespace clues::validate

#include "app/json_output.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"

namespace clues::app {
namespace {

// The innermost: `clues motion check` has two words.
const CLI::App* command_of(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* command = nullptr;
  for (const auto& word : words) {
    const auto all = (command == nullptr ? program : *command).get_subcommands({});
    const auto at = std::find_if(all.begin(), all.end(), [&](const CLI::App* one) { return word == one->get_name(); });
    if (at == all.end()) break;
    command = *at;
  }
  return command;
}

}  // namespace

void JsonOutput::add_to(CLI::App& command, const std::string& what) {
  command
      .add_option("--json", given_,
                  what +
                      " as JSON (docs/formats.md): on standard output, or into FILE.\n"
                      "FILE is -, ends in .json, or is given as --json=FILE")
      ->type_name("[FILE]");
}

const std::string& JsonOutput::file() const {
  static const std::string none;
  return on_stdout() ? none : given_;
}

void JsonOutput::write(const std::string& text) const {
  if (!asked()) return;
  if (on_stdout()) {
    std::fputs(text.c_str(), stdout);
  } else {
    scene::write_file_atomically(given_, text);
  }
}

std::vector<std::string> with_json_joined(const CLI::App& program, std::vector<std::string> words) {
  const CLI::App* command = command_of(program, words);
  if (command == nullptr || command->get_option_no_throw("--json") == nullptr) return words;
  const bool positionals =
      !command->get_options([](const CLI::Option* option) { return option->get_positional(); }).empty();
  const auto is_file = [&](const std::string& word) {
    return word == "-" || (!word.starts_with('-') && (word.ends_with(".json") || !positionals));
  };
  std::vector<std::string> joined;
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (*word == "--") {
      joined.insert(joined.end(), word, words.end());
      break;
    }
    joined.push_back(*word);
    if (*word == "--json=") throw scene::Error(scene::ErrorCode::bad_argument, "--json=: names no file");
    if (*word != "--json") continue;
    const bool named = word + 1 != words.end() && is_file(word[1]);
    joined.back() += named ? "=" + *++word : "=-";
  }
  return joined;
}

std::string hint_on_json(const std::vector<std::string>& joined) {
  const bool bare = std::find(joined.begin(), joined.end(), "--json=-") != joined.end();
  return bare ? "; a FILE of --json that does not end in .json is given as --json=FILE" : "";
}

void require_outside(const std::string& output, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (output.empty()) return;
  std::error_code no_output, no_folder;
  const fs::path file = fs::weakly_canonical(fs::absolute(output), no_output);
  const fs::path inside = file.lexically_relative(fs::weakly_canonical(fs::absolute(folder), no_folder));
  if (!no_output && !no_folder && !inside.empty() && *inside.begin() != "..") {
    throw scene::Error(scene::ErrorCode::bad_argument,
                       output + ": lies in " + folder.string() + ", which this command reads; name another output");
  }
}

}  // namespace clues::app

// Scripts of the shell with attacks/prelude.sh: what the tables of attacks and of scenarios are written in.
#pragma once

#include <filesystem>
#include <string>

namespace clues::tests {

// As one word of a shell.
std::string quoted(const std::string& text);

// A command for sh that becomes the script, in `folder`, with what the prelude needs: the attacked program, the folder of a
// good finding, the conformance suite, Python.
std::string script_command(const std::filesystem::path& folder, const std::filesystem::path& finding,
                           const std::string& script);

// Runs it with both outputs into a file. Its exit code; -1: killed by a signal.
int run_script(const std::filesystem::path& folder, const std::filesystem::path& finding, const std::string& script,
               const std::filesystem::path& output);

}  // namespace clues::tests

// A result that is kept to be gone on with ("clues map --cells"): two keys more at its beginning, answers_sha256 (of the question) and bytes_sha256 (of the result without them). It is
// a result all the same. What was cut short, edited, or answers another question is seen before it counts; who made it is not.
#pragma once

#include <string>
#include <string_view>

namespace clues::scene {

// `result`: as to_json_text() writes it. `question`: all that decides its bytes.
std::string sealed_result(std::string_view result, std::string_view question);

// What is wrong with kept bytes as an answer to the question; empty: nothing.
std::string flaw_of_sealed(std::string_view bytes, std::string_view question);

}  // namespace clues::scene

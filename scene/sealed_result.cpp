#include "scene/sealed_result.h"

#include <fmt/format.h>

#include "scene/result.h"

namespace clues::scene {
namespace {

constexpr std::size_t before = 2;  // "{\n"

std::string head_of(std::string_view result, std::string_view question) {
  return fmt::format("  \"answers_sha256\": \"{}\",\n  \"bytes_sha256\": \"{}\",\n", sha256_of(question),
                     sha256_of(result));
}

}  // namespace

std::string sealed_result(std::string_view result, std::string_view question) {
  return fmt::format("{}{}{}", result.substr(0, before), head_of(result, question), result.substr(before));
}

std::string flaw_of_sealed(std::string_view bytes, std::string_view question) {
  const std::size_t size = head_of("", question).size();
  if (bytes.size() < before + size) return "is empty or cut short";
  const std::string result = fmt::format("{}{}", bytes.substr(0, before), bytes.substr(before + size));
  const std::string head = head_of(result, question);
  const auto found = bytes.substr(before, size);
  if (found == head) return {};
  return found.substr(0, found.find('\n')) == head.substr(0, head.find('\n'))
             ? "was changed or cut short after it was written"
             : "is no answer to what is asked here";
}

}  // namespace clues::scene

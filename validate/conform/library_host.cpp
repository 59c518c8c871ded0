// dlopen, one symbol, and a check that every byte of the answer was written.
#include "validate/conform/library_host.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "scene/messages/error.h"
#include "validate/clues_iut.h"
#include "validate/conform/server.h"

namespace clues::validate {
namespace {

using scene::Error;
using scene::ErrorCode;
using Function = decltype(&clues_iut_pvs);

Function load(const std::filesystem::path& library) {
  std::error_code ignored;
  if (!std::filesystem::exists(library, ignored)) {
    throw Error(ErrorCode::file_not_found, library.string() + ": no such file; give the path of a shared library");
  }
  if (!std::filesystem::is_regular_file(library, ignored)) {  // dlopen would wait for a pipe
    throw Error(ErrorCode::bad_argument, library.string() + ": is no regular file; give the path of a shared library");
  }
  // By its absolute path: dlopen would look for a bare name elsewhere. Never unloaded.
  void* const handle = dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw Error(ErrorCode::bad_argument, library.string() + ": cannot be loaded as a shared library: " + dlerror());
  }
  void* const symbol = dlsym(handle, "clues_iut_pvs");
  if (symbol == nullptr) {
    throw Error(
        ErrorCode::bad_argument,
        library.string() + ": has no function clues_iut_pvs; declare it as in clues_iut.h, extern \"C\" and exported");
  }
  return reinterpret_cast<Function>(symbol);
}

Answer call(Function function, const Request& request) {
  if (!request.is_plain()) {  // by a request that does not keep to what serve_library said of itself
    Answer answer;
    answer.kind = AnswerKind::skipped;
    answer.message = "clues_iut_pvs is not told which triangles block";
    return answer;
  }
  constexpr std::uint8_t unwritten = 0xa5;
  std::vector<std::uint8_t> visible(request.mesh.triangles.size(), unwritten);
  const int status =
      function(request.mesh.points.data()->data(), request.mesh.points.size(), request.mesh.triangles.data()->data(),
               request.mesh.triangles.size(), request.cell.data()->data(), request.cell.size(), visible.data());
  Answer answer;
  if (status != CLUES_IUT_OK) {
    answer.kind = status == CLUES_IUT_SKIPPED    ? AnswerKind::skipped
                  : status == CLUES_IUT_REJECTED ? AnswerKind::rejected_input
                                                 : AnswerKind::errored;
    answer.message = fmt::format("clues_iut_pvs returned {}", status);
    return answer;
  }
  for (std::size_t t = 0; t < visible.size(); ++t) {
    if (visible[t] > 1) {
      answer.kind = AnswerKind::malformed_output;
      answer.message = fmt::format("clues_iut_pvs left {} in visible[{}]{}; write 0 or 1", visible[t], t,
                                   visible[t] == unwritten ? ", as it was before the call" : "");
      answer.visible.clear();
      return answer;
    }
    if (visible[t] == 1) answer.visible.push_back(static_cast<std::uint32_t>(t));
  }
  return answer;
}

}  // namespace

void serve_library(const std::filesystem::path& library, std::istream& in) {
  const int replies = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (replies < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    throw std::runtime_error("cannot set standard output aside");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(fdopen(replies, "w"), &std::fclose);
  if (!out) throw std::runtime_error("cannot set standard output aside");
  Implementation about;
  about.name = library.filename().string();
  about.version = "unknown";
  about.solid = false;  // the function knows no modes
  const auto function = load(library);
  serve(in, out.get(), about, [function](const Request& request) { return call(function, request); });
}

}  // namespace clues::validate

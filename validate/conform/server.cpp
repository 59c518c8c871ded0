// A request in, a reply out.
#include "validate/conform/server.h"

#include <stdexcept>
#include <string>

#include "scene/messages/error.h"

namespace clues::validate {
namespace {

Answer answer_or_refuse(const Request& request, const std::function<Answer(const Request&)>& compute) {
  Answer answer;
  try {
    return compute(request);
  } catch (const scene::Error& error) {
    answer.kind = error.code() == scene::ErrorCode::internal ? AnswerKind::errored : AnswerKind::rejected_input;
    answer.message = error.what();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    answer.kind = AnswerKind::errored;
    answer.message = error.what();
  }
  return answer;
}

}  // namespace

void serve(std::istream& in, std::FILE* out, const Implementation& about,
           const std::function<Answer(const Request&)>& answer) {
  std::string line;
  while (std::getline(in, line)) {
    const auto request = parse_request(line);
    if (request.kind == Request::Kind::stop) return;
    const auto reply = request.kind == Request::Kind::start ? start_reply(about)
                                                            : run_reply(request.seq, answer_or_refuse(request, answer));
    if (std::fputs((reply + "\n").c_str(), out) < 0 || std::fflush(out) != 0) {
      throw std::runtime_error("cannot write a reply");
    }
  }
}

}  // namespace clues::validate

// The JSON lines between the runner and an implementation under test (docs/protocol.md, protocol 1): both ends of every message. Objects
// are closed: an unknown field is an error, so that a misspelt one is noticed.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/flagged_mesh.h"
#include "validate/vectors/suite.h"

namespace clues::validate {

inline constexpr int protocol_version = 1;

// What an implementation says about itself.
struct Implementation {
  std::string name, version;
  std::string language, homepage, issues;  // optional
  bool sheet = true, solid = true;         // the modes that it knows
  bool float32 = false;                    // it reads coordinates as single precision
  bool see_through = false;                // it knows triangles that do not block or do not count (D22)
};

// What came of one question.
enum class AnswerKind {
  visible,           // a PVS
  unsupported,       // not asked: the capabilities say no
  skipped,           // not asked, or not answered on purpose
  rejected_input,    // the implementation calls the input bad
  errored,           // it tried and says that it failed
  malformed_output,  // what came back is no answer
  crash,
  timeout,
  resource,  // it ran out of memory
};

struct Answer {
  AnswerKind kind = AnswerKind::visible;
  std::vector<std::uint32_t> visible;  // ascending, unique
  std::string message;                 // why, when there is no PVS
  std::string issue_url;               // of skipped; may be empty
  std::string stderr_tail;             // of malformed_output, crash, timeout, resource, errored
};

// A message that is not what docs/protocol.md says. what() is one line.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The runner's end. Lines without the end of the line.
std::string start_request();
std::string run_request(std::uint32_t seq, const VectorCase& test);
std::string stop_request();
Implementation parse_start_reply(std::string_view line);  // throws ProtocolError
// Never throws: what is wrong with the line becomes an answer of kind malformed_output.
Answer parse_reply(std::string_view line, std::uint32_t seq, std::size_t triangles);

// The implementation's end.
struct Request {
  enum class Kind { start, run, stop } kind = Kind::start;
  std::uint32_t seq = 0;  // of run, as the rest
  CaseMode mode = CaseMode::sheet;
  scene::TriangleMesh mesh;
  std::vector<std::uint8_t> blocks, counts;  // D22, as in FlaggedMesh
  std::vector<scene::Point> cell;

  bool is_plain() const { return blocks.empty() && counts.empty(); }
};
Request parse_request(std::string_view line);  // throws ProtocolError
std::string start_reply(const Implementation& implementation);
std::string run_reply(std::uint32_t seq,
                      const Answer& answer);  // visible, skipped, rejected_input, errored, malformed_output

}  // namespace clues::validate

// Reads a whole file (D1 input). POSIX calls, because they say why something failed.
#include "scene/formats/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "scene/messages/error.h"

namespace clues::scene {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

class OpenFile {
 public:
  // O_NONBLOCK: to open a pipe would wait for its writer. It means nothing to a regular file.
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (descriptor_ >= 0) return;
    const int error = errno;
    if (error == ENOENT || error == ENOTDIR) {
      throw Error(ErrorCode::file_not_found, path.string() + ": there is no such file; check the path");
    }
    throw Error(ErrorCode::file_unreadable, path.string() + ": cannot open: " + reason(error) + "; check the file");
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { ::close(descriptor_); }

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

std::string read_file_bytes(const std::filesystem::path& path, std::uint64_t most) {
  const OpenFile file(path);
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorCode::file_unreadable, path.string() + ": " + what);
  };
  const auto fail_as_too_long = [&] {
    fail("is longer than the " + std::to_string(most) + " bytes that are read; is it the right file?");
  };
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0) fail("cannot read: " + reason(errno) + "; check the file");
  if (S_ISDIR(status.st_mode)) fail("is a folder; name a file in it");
  if (!S_ISREG(status.st_mode)) fail("is a pipe or a device; write it into a regular file first");
  if (static_cast<std::uint64_t>(status.st_size) > most) fail_as_too_long();
  // The size is a guess only (files of the system have none, others may grow): what counts is the end of file.
  std::string bytes(static_cast<std::size_t>(status.st_size) + 1, '\0');
  std::size_t used = 0;
  while (true) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size() + 4096);
    const auto got = ::read(file.descriptor(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("cannot read: " + reason(errno) + "; check the file");
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    if (used > most) fail_as_too_long();
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace clues::scene

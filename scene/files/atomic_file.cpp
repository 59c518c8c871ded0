// Whole-or-nothing output: temporary in the same folder, fsync, rename. Results (D7) are never half there.
#include "scene/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "scene/messages/error.h"

namespace clues::scene {
namespace {

namespace fs = std::filesystem;

// Removes itself unless it was moved to its target.
class TemporaryFile {
 public:
  // Another writer, or one that was killed, may hold a name: O_EXCL then says so, and the next number is tried.
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    constexpr int most_tries = 10000;
    for (int i = 0; i < most_tries; ++i) {
      path_ = target.parent_path() / (".clues-" + std::to_string(i) + ".tmp");
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0) return;
      if (errno != EEXIST) break;
    }
    fail_unwritable(target_, "cannot create a file in this folder", errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!moved_) ::unlink(path_.c_str());
  }

  void keep_mode_of_target() {
    struct stat status {};
    if (::stat(target_.c_str(), &status) == 0 && ::fchmod(descriptor_, status.st_mode & 0777) != 0) {
      fail_unwritable(target_, "cannot keep the permissions", errno);
    }
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const auto written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail_unwritable(target_, "cannot write", errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void move_to_target() {
    if (::fsync(descriptor_) != 0) fail_unwritable(target_, "cannot write", errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail_unwritable(target_, "cannot write", errno);
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail_unwritable(target_, "cannot replace the file", errno);
    moved_ = true;
  }

 private:
  fs::path target_;
  fs::path path_;
  int descriptor_ = -1;
  bool moved_ = false;
};

}  // namespace

void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void fail_unwritable(const fs::path& path, const std::string& what, int error) {
  throw Error(ErrorCode::file_unwritable, path.string() + ": " + what + ": " + std::generic_category().message(error) +
                                              "; check the folder, its permissions and the space on the disk");
}

bool is_temporary_name(std::string_view name) {
  constexpr std::string_view before = ".clues-", after = ".tmp";
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) return false;
  name = name.substr(before.size(), name.size() - before.size() - after.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  // A link stays a link: what it points to is replaced.
  if (fs::is_symlink(path, ignored) && !fs::exists(path, ignored)) {
    throw Error(ErrorCode::file_unwritable,
                path.string() + ": is a link to what is not there; remove it, or name another file");
  }
  std::error_code failed;
  const auto target = fs::is_symlink(path, ignored) ? fs::canonical(path, failed) : path;
  if (failed) fail_unwritable(path, "cannot follow this link", failed.value());
  const auto type = fs::status(target, ignored).type();
  if (type == fs::file_type::directory) fail_unwritable(path, "cannot write", EISDIR);
  // A rename would replace the device itself.
  if (type != fs::file_type::regular && type != fs::file_type::not_found) {
    throw Error(ErrorCode::file_unwritable, path.string() + ": is not a regular file; name one, or a new one");
  }
  if (!target.has_filename()) fail_unwritable(path, "cannot write", ENOENT);
  TemporaryFile file(target);
  file.keep_mode_of_target();
  file.write(bytes);
  file.move_to_target();
  flush_folder(target.parent_path());
}

}  // namespace clues::scene

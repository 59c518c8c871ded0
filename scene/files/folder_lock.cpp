#include "scene/files/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "scene/messages/error.h"

namespace clues::scene {

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / ".clues-lock") {
  const auto fail = [&](const std::string& what) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Error(ErrorCode::file_unwritable,
                file_.string() + ": cannot lock this folder: " + what + "; check the folder and its permissions");
  };
  while (true) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0) fail(std::generic_category().message(errno));
    struct stat held {
    }, named{};
    if (::fstat(descriptor_, &held) != 0) fail(std::generic_category().message(errno));
    if (!S_ISREG(held.st_mode)) fail("it is not a regular file");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) fail(std::generic_category().message(errno));
      ::close(descriptor_);
      throw Error(ErrorCode::bad_argument,
                  folder.string() + ": another clues works in this folder; wait for its end, or choose another folder");
    }
    // Whoever had the lock before may have taken the file away between our open and our lock.
    if (::stat(file_.c_str(), &named) == 0 && named.st_dev == held.st_dev && named.st_ino == held.st_ino) return;
    ::close(descriptor_);
  }
}

FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace clues::scene

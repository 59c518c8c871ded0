#include "scene/files/folder_update.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include "scene/files/atomic_file.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void not_ours(const fs::path& path, const char* needed) {
  throw Error(ErrorCode::bad_argument,
              path.string() + ": is no " + needed + ", so clues did not make it, and leaves it alone; move it away");
}

enum class Kind { none, file, folder, other };

Kind kind_of(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return Kind::none;
    fail_unwritable(path, "cannot look at it", errno);
  }
  return S_ISREG(status.st_mode) ? Kind::file : S_ISDIR(status.st_mode) ? Kind::folder : Kind::other;
}

fs::path pending_in(const fs::path& folder) { return folder / ".clues-pending"; }

fs::path pending_file(const fs::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '/', '+');
  return pending_in(folder) / name;
}

bool is_committed(const fs::path& folder) {
  const Kind kind = kind_of(pending_in(folder));
  if (kind != Kind::none && kind != Kind::folder) not_ours(pending_in(folder), "folder");
  return kind == Kind::folder && kind_of(pending_file(folder, "commit")) == Kind::file;
}

// Where files of these names are to go there must be files, or nothing.
void require_ours(const fs::path& folder, FileNames names) {
  for (const fs::path name : names) {
    if (name.has_parent_path()) {
      const Kind kind = kind_of(folder / name.parent_path());
      if (kind == Kind::none) continue;
      if (kind != Kind::folder) not_ours(folder / name.parent_path(), "folder");
    }
    is_our_file(folder / name);
  }
}

// What is there under our names, and temporary files of ours; then the folder, if that was all.
void clear(const fs::path& folder, FileNames names) {
  if (kind_of(pending_in(folder)) != Kind::folder) return;
  ::unlink(pending_file(folder, "commit").c_str());
  flush_folder(pending_in(folder));
  for (const char* name : names) ::unlink(pending_file(folder, name).c_str());
  std::error_code ignored;
  std::vector<fs::path> temporaries;
  for (auto at = fs::directory_iterator(pending_in(folder), ignored); at != fs::directory_iterator();
       at.increment(ignored)) {
    if (is_temporary_name(at->path().filename().string())) temporaries.push_back(at->path());
    if (ignored) break;
  }
  for (const fs::path& file : temporaries) ::unlink(file.c_str());
  ::rmdir(pending_in(folder).c_str());
}

void move_committed(const fs::path& folder, FileNames names) {
  require_ours(folder, names);
  for (std::size_t i = names.size(); i-- > 0;) {
    const fs::path from = pending_file(folder, names[i]), to = folder / names[i];
    if (kind_of(from) != Kind::file) continue;
    if (to.parent_path() != folder && ::mkdir(to.parent_path().c_str(), 0777) != 0 && errno != EEXIST)
      fail_unwritable(to.parent_path(), "cannot make this folder", errno);
    if (std::rename(from.c_str(), to.c_str()) != 0) fail_unwritable(to, "cannot replace the file", errno);
    if (to.parent_path() != folder) flush_folder(to.parent_path());
  }
  flush_folder(folder);
  clear(folder, names);
}

}  // namespace

bool is_our_file(const fs::path& path) {
  const Kind kind = kind_of(path);
  if (kind != Kind::none && kind != Kind::file) not_ours(path, "regular file");
  return kind == Kind::file;
}

FolderUpdate::FolderUpdate(fs::path folder, FileNames names)
    : folder_(std::move(folder)), names_(names), lock_(folder_) {
  if (is_committed(folder_)) move_committed(folder_, names_);
  clear(folder_, names_);
  if (is_committed(folder_)) fail_unwritable(pending_file(folder_, "commit"), "cannot remove it", errno);
  require_ours(folder_, names_);
  if (::mkdir(pending_in(folder_).c_str(), 0777) != 0 && errno != EEXIST)
    fail_unwritable(pending_in(folder_), "cannot make this folder", errno);
}

FolderUpdate::~FolderUpdate() {
  try {
    if (!is_committed(folder_)) clear(folder_, names_);
  } catch (...) {  // what is pending without a commit counts for nothing
  }
}

void FolderUpdate::put(const std::string& name, std::string_view bytes) {
  write_file_atomically(pending_file(folder_, name), bytes);
}

void FolderUpdate::commit() {
  write_file_atomically(pending_file(folder_, "commit"), "");
  move_committed(folder_, names_);
}

void finish_update(const fs::path& folder, FileNames names) {
  if (!is_committed(folder)) return;
  const FolderLock lock(folder);
  if (is_committed(folder)) move_committed(folder, names);
}

}  // namespace clues::scene

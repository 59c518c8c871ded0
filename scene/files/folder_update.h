// Several files of one folder that change together: all of them or none, whatever fails and whenever the program is killed. The new files are put into
// FOLDER/.clues-pending first; the file `commit` in it says that they are whole; then each is moved over the old one. What a killed program left there is moved by
// whoever comes next, or forgotten when it was not whole. Only files of the names given here are ever written, moved or removed: what else lies in
// the folder stays.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scene/files/folder_lock.h"

namespace clues::scene {

// Names may have one folder in them: "original/scene.off". The first is the one that says that there is something: it is moved last.
using FileNames = std::span<const char* const>;

// Whether there is a file of this name. Throws Error bad_argument where there is something else: a link, a folder, a pipe; then
// clues did not make it.
bool is_our_file(const std::filesystem::path& path);

class FolderUpdate {
 public:
  // The folder must exist; it is locked until the end. Finishes an update that was committed and killed. Throws Error file_unwritable; bad_argument as FolderLock, and
  // where one of the names is a link or a folder: then it is not ours.
  FolderUpdate(std::filesystem::path folder, FileNames names);
  ~FolderUpdate();  // without commit(): all stays as it was
  FolderUpdate(const FolderUpdate&) = delete;
  FolderUpdate& operator=(const FolderUpdate&) = delete;

  void put(const std::string& name, std::string_view bytes);
  // Throws Error file_unwritable. Once this has begun to move files it is no more undone: the next finish_update() goes on.
  void commit();

 private:
  std::filesystem::path folder_;
  FileNames names_;
  FolderLock lock_;
};

// To be called before the files are read. Does nothing where nothing is pending. Throws Error as FolderUpdate.
void finish_update(const std::filesystem::path& folder, FileNames names);

}  // namespace clues::scene

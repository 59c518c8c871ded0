// One program at a time writes into a folder of ours. The lock goes with the process, however it ends; the file .clues-lock that a kill leaves behind locks nothing.
#pragma once

#include <filesystem>

namespace clues::scene {

class FolderLock {
 public:
  // Throws Error bad_argument when another process works in the folder (nothing is waited for), file_unwritable when it cannot be locked.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();  // takes the file away
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace clues::scene

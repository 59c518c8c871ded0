// A fresh folder for intermediate files, of its user alone; removed with everything in it when the object ends.
#pragma once

#include <filesystem>
#include <string>

namespace clues::scene {

class TemporaryFolder {
 public:
  TemporaryFolder();  // throws Error file_unwritable
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace clues::scene

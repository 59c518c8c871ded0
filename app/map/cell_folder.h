// Where `clues map --cells` puts its results: a folder with a file per cell, each written when its cell is finished, and cells.json, which says
// what was asked. One process at a time works there. Each file begins with the hash of the question that it answers and the hash of its own bytes, and both are
// compared before it counts: so a run that was stopped can go on, and never mixes the answers to two questions.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/cell_spec.h"
#include "scene/files/folder_lock.h"

namespace clues::app {

class CellFolder {
 public:
  // `request`: everything that decides the bytes of the results, as JSON text. Makes the folder where it does not exist. Throws scene::Error file_unwritable;
  // bad_argument when another process is at work, when the folder holds results already and `resume` is not set, results of another request, or without a request,
  // and when one of its files was changed, cut short or replaced by a link.
  CellFolder(std::filesystem::path folder, std::string request, const std::vector<scene::CellSpec>& cells, bool resume);
  // Takes the folder away again if it was made here and no result is in it.
  ~CellFolder();
  CellFolder(const CellFolder&) = delete;
  CellFolder& operator=(const CellFolder&) = delete;

  // "0,1,2" has the file cell-0-1-2.clues.json.
  bool has(const scene::CellSpec& cell) const;
  void put(const scene::CellSpec& cell, const std::string& bytes) const;  // all of the file or nothing

 private:
  std::filesystem::path file_of(const scene::CellSpec& cell) const;
  void require_no_others(const std::vector<scene::CellSpec>& cells) const;

  std::filesystem::path folder_;
  std::string request_;
  bool made_ = false;
  std::unique_ptr<scene::FolderLock> lock_;
};

}  // namespace clues::app

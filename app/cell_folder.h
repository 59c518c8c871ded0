// Where `clues map --cells` puts its results: a folder with a file per cell, each written when its cell is finished, and cells.json, which says
// what was asked. So a run that was stopped can go on, and never mixes the answers to two questions.
#pragma once

#include <filesystem>
#include <string>

namespace clues::app {

class CellFolder {
 public:
  // `request`: everything that decides the bytes of the results, as JSON text. Makes the folder where it does not exist. Throws scene::Error file_unwritable;
  // bad_argument when the folder holds results already and `resume` is not set, or holds those of another request.
  CellFolder(std::filesystem::path folder, const std::string& request, bool resume);
  // Takes the folder away again if it was made here and no result is in it.
  ~CellFolder();
  CellFolder(const CellFolder&) = delete;
  CellFolder& operator=(const CellFolder&) = delete;

  // `cell` is the name of a grid cell: "0,1,2" has the file cell-0-1-2.clues.json.
  bool has(const std::string& cell) const;
  void put(const std::string& cell, const std::string& bytes) const;  // all of the file or nothing

 private:
  std::filesystem::path file_of(std::string cell) const;

  std::filesystem::path folder_;
  bool made_ = false;
};

}  // namespace clues::app

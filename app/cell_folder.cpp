#include "app/cell_folder.h"

#include <iterator>
#include <system_error>
#include <utility>

#include "app/common.h"
#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/formats/file_bytes.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

constexpr const char* request_file = "cells.json";

}  // namespace

CellFolder::CellFolder(fs::path folder, const std::string& request, bool resume) : folder_(std::move(folder)) {
  const fs::path file = folder_ / request_file;
  if (fs::exists(file)) {
    if (!resume) {
      throw Error(
          ErrorCode::bad_argument,
          folder_.string() + ": holds results of an earlier run; give --resume to go on with it, or another folder");
    }
    if (scene::read_file_bytes(file) != request) {
      throw Error(ErrorCode::bad_argument,
                  file.string() +
                      ": the run that was begun here asked for something else (another scene, grid or option); "
                      "repeat its command with --resume, or give another folder");
    }
  }
  made_ = make_folder(folder_);
  try {
    if (!fs::exists(file)) scene::write_file_atomically(file, request);
  } catch (...) {
    std::error_code ignored;
    if (made_) fs::remove(folder_, ignored);
    throw;
  }
}

CellFolder::~CellFolder() {
  std::error_code ignored;
  if (!made_ || std::distance(fs::directory_iterator(folder_, ignored), {}) != 1) return;
  fs::remove(folder_ / request_file, ignored);
  fs::remove(folder_, ignored);
}

fs::path CellFolder::file_of(std::string cell) const {
  if (cell.find_first_not_of("0123456789,") != std::string::npos) cell = "0";  // a single cell, not a grid
  for (char& c : cell) {
    if (c == ',') c = '-';
  }
  return folder_ / ("cell-" + cell + ".clues.json");
}

bool CellFolder::has(const std::string& cell) const { return fs::exists(file_of(cell)); }

void CellFolder::put(const std::string& cell, const std::string& bytes) const {
  scene::write_file_atomically(file_of(cell), bytes);
}

}  // namespace clues::app

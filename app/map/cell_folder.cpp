#include "app/map/cell_folder.h"

#include <fmt/format.h>

#include <set>
#include <system_error>
#include <utility>

#include "app/common.h"
#include "scene/files/atomic_file.h"
#include "scene/files/folder_update.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/sealed_result.h"

namespace clues::app {
namespace {

namespace fs = std::filesystem;
using scene::Error;
using scene::ErrorCode;

constexpr const char* request_file = "cells.json";

bool is_cell_file(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("cell-") && name.ends_with(".clues.json");
}

std::string question_of(const std::string& request, const scene::CellSpec& cell) {
  std::string text = request + cell.name + "\n";
  for (const auto& p : cell.points) text += fmt::format("{:a} {:a} {:a}\n", p[0], p[1], p[2]);
  return text;
}

}  // namespace

CellFolder::CellFolder(fs::path folder, std::string request, const std::vector<scene::CellSpec>& cells, bool resume)
    : folder_(std::move(folder)), request_(std::move(request)) {
  made_ = make_folder(folder_);
  std::error_code error;
  folder_ = fs::canonical(folder_, error);
  if (error) throw Error(ErrorCode::file_unwritable, folder_.string() + ": cannot be found: " + error.message());
  try {
    lock_ = std::make_unique<scene::FolderLock>(folder_);
    const fs::path file = folder_ / request_file;
    const bool begun = scene::is_our_file(file);
    if (begun && !resume) {
      throw Error(
          ErrorCode::bad_argument,
          folder_.string() + ": holds results of an earlier run; give --resume to go on with it, or another folder");
    }
    if (begun && scene::read_file_bytes(file) != request_) {
      throw Error(ErrorCode::bad_argument,
                  file.string() +
                      ": the run that was begun here asked for something else (another scene, grid or option); "
                      "repeat its command with --resume, or give another folder");
    }
    require_no_others(begun ? cells : std::vector<scene::CellSpec>{});
    if (!begun) scene::write_file_atomically(file, request_);
  } catch (...) {
    lock_.reset();
    if (made_) fs::remove(folder_, error);
    throw;
  }
}

CellFolder::~CellFolder() {
  std::error_code ignored;
  if (made_) {
    bool any = false;
    for (const auto& entry : fs::directory_iterator(folder_, ignored)) any = any || is_cell_file(entry.path());
    if (!any && !ignored) fs::remove(folder_ / request_file, ignored);
  }
  lock_.reset();
  if (made_) fs::remove(folder_, ignored);  // only where it is empty
}

// Results of which nothing says what they answer, or that are no part of this run, would be taken for its own by whoever reads the folder.
void CellFolder::require_no_others(const std::vector<scene::CellSpec>& cells) const {
  std::set<fs::path> ours;
  for (const auto& cell : cells) ours.insert(file_of(cell));
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (!is_cell_file(entry.path()) || ours.contains(entry.path())) continue;
    throw Error(ErrorCode::bad_argument, entry.path().string() +
                                             (cells.empty() ? ": a result, and no cells.json says what it answers"
                                                            : ": a result that is no part of this run") +
                                             "; move it away, or give another folder");
  }
  if (error) throw Error(ErrorCode::file_unreadable, folder_.string() + ": cannot be read: " + error.message());
}

fs::path CellFolder::file_of(const scene::CellSpec& cell) const {
  std::string name = cell.name;
  if (name.find_first_not_of("0123456789,") != std::string::npos) name = "0";  // a single cell, not a grid
  for (char& c : name) {
    if (c == ',') c = '-';
  }
  return folder_ / ("cell-" + name + ".clues.json");
}

bool CellFolder::has(const scene::CellSpec& cell) const {
  const fs::path file = file_of(cell);
  if (!scene::is_our_file(file)) return false;
  const std::string flaw = scene::flaw_of_sealed(scene::read_file_bytes(file), question_of(request_, cell));
  if (flaw.empty()) return true;
  throw Error(ErrorCode::bad_argument, file.string() + ": " + flaw + "; remove it, and it is made again");
}

void CellFolder::put(const scene::CellSpec& cell, const std::string& bytes) const {
  scene::write_file_atomically(file_of(cell), scene::sealed_result(bytes, question_of(request_, cell)));
}

}  // namespace clues::app

// The files that a page of `clues view` shows (page_data.h). Everything is read by the readers that all commands use, and checked, before it goes in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace clues::app {

class ViewData {
 public:
  // Files are named without their folders, or as seen from `root`.
  explicit ViewData(std::filesystem::path root = {});
  ~ViewData();
  ViewData(ViewData&&) noexcept;
  ViewData& operator=(ViewData&&) noexcept;

  // Scenes, results, bakes, deltas, walks, hierarchies, judgements, umbrae, conformance reports, and folders of findings (or their finding.json) or of campaigns. The scene that a file is about is taken from the
  // others, or read where the file says it is, or from beside the file. Throws Error: as the readers; file_not_found where a scene is not there, unsupported
  // for other files. O(bytes).
  void add_files(const std::vector<std::filesystem::path>& files);

  std::size_t count() const;  // files, with scenes that were not named
  std::string text() const;   // JSON; doubles as they are, the same files give the same bytes

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clues::app

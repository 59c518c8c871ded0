// The page of `clues view` (app/viewer/), with data in it. The page is built by Node and put into the program when that is compiled.
#pragma once

#include <string>
#include <string_view>

namespace clues::app {

// How every such page begins, up to what differs.
inline constexpr std::string_view view_page_mark = "<meta name=\"generator\" content=\"clues view\">";

// False where the program was built without Node.
bool has_view_page();

// The page with `data` (JSON, "clues-view/1", docs/viewer.md) in it; with an empty text a page that waits for files. Throws Error unsupported, with what to do, where there
// is no page.
std::string view_page(const std::string& data);

}  // namespace clues::app

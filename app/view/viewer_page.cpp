#include "app/view/viewer_page.h"

#include "scene/messages/error.h"

// CLUES_VIEW_PAGE names the file that app/viewer/CMakeLists.txt has Node make.
#ifdef CLUES_VIEW_PAGE
__asm__(
    ".pushsection .rodata\n"
    ".globl clues_view_page_begin\n"
    ".globl clues_view_page_end\n"
    "clues_view_page_begin:\n"
    ".incbin \"" CLUES_VIEW_PAGE
    "\"\n"
    "clues_view_page_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" {
extern const char clues_view_page_begin[];
extern const char clues_view_page_end[];
}
#endif

namespace clues::app {
namespace {

constexpr std::string_view place_of_data = "<!--CLUES-DATA-->";

std::string_view embedded() {
#ifdef CLUES_VIEW_PAGE
  return {clues_view_page_begin, static_cast<std::size_t>(clues_view_page_end - clues_view_page_begin)};
#else
  return {};
#endif
}

// JSON whose text cannot end the script element that it stands in: "<" is only found within texts.
std::string within_script(const std::string& text) {
  std::string out;
  out.reserve(text.size() + text.size() / 64);
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

bool has_view_page() { return !embedded().empty(); }

std::string view_page(const std::string& data) {
  if (!has_view_page()) {
    throw scene::Error(
        scene::ErrorCode::unsupported,
        "this program was built without the page of `clues view`, for want of Node.js and npm; `./run build` installs "
        "both (packages nodejs and npm) and builds it anew");
  }
  const std::string_view page = embedded();
  const auto place = page.find(place_of_data);
  if (place == std::string_view::npos)
    throw scene::Error(scene::ErrorCode::internal, "the page of `clues view` has no place for data");
  std::string out(page.substr(0, place));
  if (!data.empty()) {
    out += "<script type=\"application/json\" id=\"clues-data\">";
    out += within_script(data);
    out += "</script>";
  }
  out += page.substr(place + place_of_data.size());
  return out;
}

}  // namespace clues::app

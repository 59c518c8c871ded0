#include "scene/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "scene/json_reader.h"

namespace clues::scene {
namespace {

constexpr std::uint64_t most_buffer_bytes = std::uint64_t{1} << 32;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

// RFC 4648, padded or not; none where it is no base64.
std::optional<std::string> from_base64(std::string_view text) {
  static const auto values = [] {
    std::array<int, 256> table{};
    table.fill(-1);
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i) table[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    return table;
  }();
  if (text.size() % 4 == 0) {
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  }
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t gathered = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    gathered = (gathered << 6 | static_cast<std::uint32_t>(value)) & 0xFFFF;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(gathered >> bits & 0xFF));
  }
  return bytes;
}

// %41 is A.
std::optional<std::string> without_percents(std::string_view uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    if (i + 2 >= uri.size() || digit(uri[i + 1]) < 0 || digit(uri[i + 2]) < 0) return std::nullopt;
    path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
    i += 2;
  }
  return path;
}

// Relative, and not out of the folder of the document: a scene of a stranger names no other files.
bool stays_below(const std::filesystem::path& path) {
  if (path.empty() || path.is_absolute() || path.native().find('\0') != std::string::npos) return false;
  return std::none_of(path.begin(), path.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

// Nothing for a URI that names no such file.
std::optional<std::string> path_of(const std::string& uri) {
  auto path = without_percents(uri);
  if (!path || !stays_below(*path) || uri.find("://") != std::string::npos) return std::nullopt;
  return path;
}

bool has_data(const std::string& uri) { return uri.starts_with("data:"); }

// What a file may require without a change of its geometry.
bool is_harmless(const std::string& extension) {
  static const std::set<std::string> harmless{"KHR_lights_punctual",   "KHR_texture_basisu", "KHR_texture_transform",
                                              "EXT_texture_webp",      "EXT_texture_avif",   "KHR_xmp_json_ld",
                                              "KHR_materials_variants"};
  return harmless.contains(extension) || (extension.starts_with("KHR_materials_"));
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, const std::string& file, const BufferLoader& load)
    : file_(file), load_(load) {
  JsonLimits limits;
  limits.depth = 64;
  json_ = parse_json(take_chunks(bytes), file, limits);
  root_ = {&json_, {file, "glTF, version", 2}};
  if (!json_.is_object()) fail_in(file, ErrorCode::malformed, "is no glTF document: no object; export it again");
  const auto asset = root_.object("asset");
  if (!asset) fail_in(file, ErrorCode::malformed, "is no glTF document: no \"asset\"; export it again");
  const std::string version = asset->text("version", "");
  if (version != "2" && !version.starts_with("2."))
    fail_in(file, ErrorCode::unsupported,
            "is glTF of version " + excerpt(version) + "; only 2.0 is read: export it again as that");
  if (const std::string least = asset->text("minVersion", "2.0"); least != "2.0")
    fail_in(file, ErrorCode::unsupported,
            "needs a reader of glTF " + excerpt(least) + "; only 2.0 is read: export it again as that");
  check_extensions();
  nodes_ = root_.objects("nodes", "node");
  meshes_ = root_.objects("meshes", "mesh");
  materials_ = root_.objects("materials", "material");
  accessors_ = root_.objects("accessors", "accessor");
  buffer_views_ = root_.objects("bufferViews", "buffer view");
  buffers_ = root_.objects("buffers", "buffer");
  loaded_.resize(buffers_.size());
  is_loaded_.resize(buffers_.size());
}

// Of a .glb file the JSON; `chunk_` is set.
std::string_view GltfDocument::take_chunks(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return bytes;
  constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;
  const auto fail = [&](const std::string& what) { fail_in(file_, ErrorCode::malformed, what); };
  if (bytes.size() < 20) fail(fmt::format("ends within its header, after {} bytes; copy it again", bytes.size()));
  if (word_at(bytes, 4) != 2)
    fail_in(file_, ErrorCode::unsupported,
            fmt::format("is a .glb file of version {}; only 2 is read: export it again as that", word_at(bytes, 4)));
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size() || length < 20)
    fail(fmt::format("says that it has {} bytes, and has {}; copy it again", length, bytes.size()));
  is_binary_ = true;
  bytes = bytes.substr(0, length);
  std::string_view json;
  for (std::size_t at = 12, number = 0; at < length; ++number) {
    if (length - at < 8) fail(fmt::format("chunk {} ends within its header; export it again", number));
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    if (size > length - at - 8)
      fail(fmt::format("chunk {} of {} bytes reaches past the end; copy the file again", number, size));
    const auto content = bytes.substr(at + 8, size);
    if (number == 0 && type != json_chunk) fail("the first chunk is no JSON; export it again");
    if (number == 0) json = content;
    if (number == 1 && type == bin_chunk) chunk_ = content;
    at += 8 + size;
    at = std::min((at + 3) / 4 * 4, length);
  }
  return json;
}

void GltfDocument::check_extensions() const {
  const Json* required = root_.find("extensionsRequired");
  if (required == nullptr) return;
  if (!required->is_array())
    fail_in(file_, ErrorCode::malformed, "\"extensionsRequired\" is no list; export the file again");
  for (const Json& name : *required) {
    if (!name.is_string())
      fail_in(file_, ErrorCode::malformed, "\"extensionsRequired\" holds what is no name; export the file again");
    if (is_harmless(name.get<std::string>())) continue;
    fail_in(file_, ErrorCode::unsupported,
            "needs the extension " + excerpt(name.get<std::string>()) +
                ", which is not read; export it without (compression off)");
  }
}

std::vector<std::string> GltfDocument::files_of_buffers() const {
  std::vector<std::string> files;
  for (const GltfObject& buffer : buffers_) {
    const std::string uri = buffer.text("uri", "");
    if (uri.empty() || has_data(uri)) continue;
    if (auto path = path_of(uri)) files.push_back(std::move(*path));
  }
  return files;
}

std::string_view GltfDocument::bytes_of_buffer(std::uint32_t buffer) {
  const GltfObject& about = buffers_[buffer];
  const auto length = static_cast<std::size_t>(about.needed_whole("byteLength", most_buffer_bytes));
  const auto checked = [&](std::string_view bytes) {
    if (bytes.size() < length) about.fail(fmt::format("has {} bytes where it says {}", bytes.size(), length));
    return bytes.substr(0, length);
  };
  if (about.find("uri") == nullptr) {
    if (buffer != 0 || !is_binary_) about.fail("has no \"uri\", and is not the first one of a .glb file");
    return checked(chunk_);
  }
  if (is_loaded_[buffer]) return checked(loaded_[buffer]);
  const std::string uri = about.text("uri", "");
  if (has_data(uri)) {
    const auto comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
      about.fail("its data URI is not of the form data:...;base64,...");
    auto decoded = from_base64(std::string_view(uri).substr(comma + 1));
    if (!decoded) about.fail("its data URI is no base64");
    loaded_[buffer] = std::move(*decoded);
  } else {
    const auto path = path_of(uri);
    if (!path) about.fail("its URI " + excerpt(uri) + " is no file in the folder of the document or below");
    loaded_[buffer] = load_(*path);
  }
  is_loaded_[buffer] = true;
  return checked(loaded_[buffer]);
}

}  // namespace clues::scene

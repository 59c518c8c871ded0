#include "scene/gltf/gltf_accessor.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace clues::scene {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 32;
constexpr std::uint64_t unsigned_byte = 5121, unsigned_short = 5123, unsigned_int = 5125, float_32 = 5126;

struct Elements {
  std::string_view bytes;
  std::size_t stride = 0;

  std::uint32_t whole(std::size_t element, std::size_t size, std::size_t part = 0) const {
    const std::size_t at = element * stride + part * size;
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  }
};

std::size_t size_of_index(const GltfObject& where, std::uint64_t component) {
  if (component == unsigned_byte) return 1;
  if (component == unsigned_short) return 2;
  if (component == unsigned_int) return 4;
  where.fail(fmt::format("its component type is {}, and indices are 5121, 5123 or 5125", component));
}

// `count` elements of `size` bytes each, from `offset` bytes into a buffer view.
Elements elements_in(GltfDocument& document, const GltfObject& where, std::uint32_t view, std::uint64_t offset,
                     std::uint64_t count, std::size_t size, bool strided) {
  const GltfObject& about = document.buffer_views()[view];
  const auto buffer = about.needed_index("buffer", "buffer", document.buffers().size());
  const auto bytes = document.bytes_of_buffer(buffer);
  const std::uint64_t first = about.whole("byteOffset", most_bytes).value_or(0);
  const std::uint64_t length = about.needed_whole("byteLength", most_bytes);
  if (first > bytes.size() || length > bytes.size() - first)
    about.fail(fmt::format("its bytes {} to {} are not in buffer {} of {} bytes", first, first + length, buffer,
                           bytes.size()));
  std::size_t stride = size;
  if (const auto given = about.whole("byteStride", 252); given && strided) stride = static_cast<std::size_t>(*given);
  if (stride < size) about.fail(fmt::format("its stride of {} is less than the {} bytes of an element", stride, size));
  const std::uint64_t used = count == 0 ? 0 : (count - 1) * stride + size;
  if (offset > length || used > length - offset)
    where.fail(fmt::format("{} elements from byte {} do not fit into the {} bytes of buffer view {}", count, offset,
                           length, view));
  return {bytes.substr(static_cast<std::size_t>(first + offset), static_cast<std::size_t>(used)), stride};
}

double real_at(const GltfObject& where, const Elements& elements, std::size_t element, std::size_t part) {
  const float x = std::bit_cast<float>(elements.whole(element, 4, part));
  if (!std::isfinite(x))
    fail_at(where.place, ErrorCode::non_finite,
            fmt::format("element {} is no finite number; export the file again", element));
  return x;
}

// Calls put(i, elements, k): value i of the accessor is element k there; first all, then those that a sparse accessor replaces.
template <class Put>
void each_value(GltfDocument& document, std::uint32_t accessor, std::size_t size, const Put& put) {
  const GltfObject& about = document.accessors()[accessor];
  const std::uint64_t count = element_count(document, accessor);
  const auto view = [&](const GltfObject& object) {
    return object.index("bufferView", "buffer view", document.buffer_views().size());
  };
  const auto offset = [](const GltfObject& object) { return object.whole("byteOffset", most_bytes).value_or(0); };
  if (const auto base = view(about)) {
    const Elements elements = elements_in(document, about, *base, offset(about), count, size, true);
    for (std::size_t i = 0; i < count; ++i) put(i, elements, i);
  }
  const auto sparse = about.object("sparse");
  if (!sparse) return;
  const std::uint64_t replaced = sparse->needed_whole("count", count);
  const auto indices = sparse->object("indices"), values = sparse->object("values");
  if (!indices || !values) about.fail("its sparse values have no \"indices\" or no \"values\"");
  const auto indices_view = view(*indices), values_view = view(*values);
  if (!indices_view || !values_view) about.fail("its sparse values have no buffer view");
  const std::size_t index_size = size_of_index(about, indices->needed_whole("componentType", most_bytes));
  const Elements places = elements_in(document, about, *indices_view, offset(*indices), replaced, index_size, false);
  const Elements news = elements_in(document, about, *values_view, offset(*values), replaced, size, false);
  for (std::size_t k = 0; k < replaced; ++k) {
    const std::size_t i = places.whole(k, index_size);
    if (i >= count) about.fail(fmt::format("its sparse value {} is for element {} of {}", k, i, count));
    put(i, news, k);
  }
}

}  // namespace

std::uint64_t element_count(const GltfDocument& document, std::uint32_t accessor) {
  const GltfObject& about = document.accessors()[accessor];
  const std::uint64_t count = about.needed_whole("count", most_bytes);
  const std::uint64_t most = about.find("bufferView") != nullptr ? most_elements : most_unbacked_elements;
  if (count > most) {
    fail_at(about.place, ErrorCode::unsupported,
            fmt::format("{} elements are more than the {} that are read; split the scene", count, most));
  }
  return count;
}

std::vector<Point> read_positions(GltfDocument& document, std::uint32_t accessor) {
  const GltfObject& about = document.accessors()[accessor];
  if (about.text("type", "") != "VEC3") about.fail("holds positions, and is no VEC3");
  if (about.needed_whole("componentType", most_bytes) != float_32) {
    fail_at(about.place, ErrorCode::unsupported,
            "holds positions that are no floats (quantized); export the file without KHR_mesh_quantization");
  }
  std::vector<Point> points(static_cast<std::size_t>(element_count(document, accessor)));
  each_value(document, accessor, 12, [&](std::size_t i, const Elements& elements, std::size_t k) {
    points[i] = {real_at(about, elements, k, 0), real_at(about, elements, k, 1), real_at(about, elements, k, 2)};
  });
  return points;
}

std::vector<std::uint32_t> read_indices(GltfDocument& document, std::uint32_t accessor) {
  const GltfObject& about = document.accessors()[accessor];
  if (about.text("type", "") != "SCALAR") about.fail("holds indices, and is no SCALAR");
  const std::size_t size = size_of_index(about, about.needed_whole("componentType", most_bytes));
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(element_count(document, accessor)));
  each_value(document, accessor, size,
             [&](std::size_t i, const Elements& elements, std::size_t k) { indices[i] = elements.whole(k, size); });
  return indices;
}

}  // namespace clues::scene

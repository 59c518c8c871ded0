// The values after a PLY header, one after the other, whether they are text or bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "scene/formats/place.h"
#include "scene/formats/ply_header.h"

namespace clues::scene {

class PlyBody {
 public:
  virtual ~PlyBody() = default;

  virtual void begin_item(std::string_view element, std::uint64_t number) = 0;
  virtual void end_item() = 0;
  virtual void finish() = 0;  // of text nothing but blanks may be left; bytes are left out with a warning
  virtual Place place() const = 0;

  virtual double read_double(PlyType type, std::string_view name) = 0;         // may be non-finite if binary
  virtual std::int64_t read_integer(PlyType type, std::string_view name) = 0;  // type is an integer
  virtual void skip(PlyType type, std::uint64_t count) = 0;

  // Length of a list whose entries have that type; throws malformed if negative or longer than what is left.
  std::uint64_t read_length(const PlyProperty& property);

 protected:
  virtual bool has_left(PlyType type, std::uint64_t count) const = 0;
};

// Both views must outlive the body.
std::unique_ptr<PlyBody> make_ply_body(const PlyHeader& header, std::string_view bytes, std::string_view file);

}  // namespace clues::scene

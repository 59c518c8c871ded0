// A value of a JSON file that knows where it stands, so that every error about it can say so. What is asked of it and is not there is an Error malformed.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/mesh/mesh.h"
#include "validate/vectors/suite.h"

namespace clues::validate {

struct Where {
  std::string file;
  std::string case_id;  // empty outside of cases
};

class Field {
 public:
  // Keeps references.
  Field(const nlohmann::json& value, const Where& where, std::string path)
      : value_(&value), where_(&where), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const;

  // An object with exactly these keys, or with any if `required` is empty.
  const Field& object(std::initializer_list<const char*> required,
                      std::initializer_list<const char*> optional = {}) const;
  bool has(const char* key) const { return value_->contains(key); }
  Field operator[](const char* key) const;
  std::vector<std::pair<std::string, Field>> members() const;

  std::vector<Field> array(std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  std::string text() const;  // not empty
  std::string text(bool (*is_kind)(std::string_view), const char* kind) const;
  // Which of the words it is.
  std::size_t one_of(std::initializer_list<const char*> words) const;
  bool flag() const;
  std::uint64_t number() const;
  // Below `limit`.
  std::uint32_t index(std::uint64_t limit, const char* of) const;
  bool is_null() const { return value_->is_null(); }

  scene::Point point() const;
  RationalPoint rational_point() const;

 private:
  const nlohmann::json* value_;
  const Where* where_;
  std::string path_;
};

}  // namespace clues::validate

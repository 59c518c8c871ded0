#include "scene/stores/database.h"

#include <gmock/gmock.h>

#include "scene/messages/error.h"
#include "tests/scene/file_size_limit.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::Database;
using testing::ElementsAre;

// Makes a database that holds a text of so many letters.
auto holding(std::size_t letters) {
  return [letters](const std::filesystem::path& copy) {
    const Database made(copy, Database::Access::write, "the text", "choose another file");
    made.run("CREATE TABLE texts (text)");
    scene::Statement(made, "INSERT INTO texts VALUES (?)").with(std::string(letters, 'x')).next();
  };
}

TEST(Database, WhatTakesThePlaceOfAnotherIsWholeOrNotThere) {
  const SceneFolder folder;
  scene::replace_database(folder.file("texts"), holding(100));
  const std::string before = read_all(folder.file("texts"));
  {
    const FileSizeLimit disk(100'000);
    EXPECT_THROW(scene::replace_database(folder.file("texts"), holding(200'000)), scene::Error);
  }
  EXPECT_EQ(read_all(folder.file("texts")), before);
  EXPECT_THAT(folder.names(), ElementsAre("texts"));
  folder.write("texts.finishing", "of a process that was killed");
  scene::replace_database(folder.file("texts"), holding(200'000));
  EXPECT_GT(read_all(folder.file("texts")).size(), 200'000U);
  EXPECT_THAT(folder.names(), ElementsAre("texts"));
}

TEST(Database, ReplacesNoFolder) {
  const SceneFolder folder;
  std::filesystem::create_directories(std::filesystem::path(folder.file("texts")) / "inside");
  EXPECT_THROW(scene::replace_database(folder.file("texts"), holding(1)), scene::Error);
  EXPECT_THAT(folder.names(), ElementsAre("texts"));
}

}  // namespace
}  // namespace clues::tests

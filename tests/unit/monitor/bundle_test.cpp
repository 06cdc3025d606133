#include "monitor/server/bundle.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/e2e/scratch.hpp"

namespace interlace::monitor {
namespace {

TEST(Bundle, HasTheFilesOfThePageUnderTheirNames) {
  const test::Scratch folder;
  folder.file("index.html", "<!doctype html>");
  folder.file("notes.md", "not a part of a page");
  std::filesystem::create_directory(folder.path("assets"));
  folder.file("assets/a-1.js", "let a;");
  const auto bundle = Bundle::load(folder.path(""));
  ASSERT_TRUE(bundle) << bundle.error();
  EXPECT_EQ(bundle->size(), 2U);
  ASSERT_NE(bundle->find("/"), nullptr);
  EXPECT_EQ(bundle->find("/"), bundle->find("/index.html"));
  EXPECT_EQ(bundle->find("/")->type, "text/html; charset=utf-8");
  EXPECT_FALSE(bundle->find("/")->immutable);
  ASSERT_NE(bundle->find("/assets/a-1.js?v=1"), nullptr);
  EXPECT_TRUE(bundle->find("/assets/a-1.js")->immutable);
}

TEST(Bundle, NoOtherNameFindsAnything) {
  const test::Scratch folder;
  folder.file("index.html", "<!doctype html>");
  const auto bundle = Bundle::load(folder.path(""));
  ASSERT_TRUE(bundle);
  for (const char* target :
       {"", "//", "/.", "/..", "/../index.html", "/./index.html", "/%2e%2e/index.html", "/..%2findex.html", "/index.html/", "/INDEX.HTML",
        "\\index.html", "/index.html%00", "/etc/passwd", "//etc/passwd", "index.html"}) {
    EXPECT_EQ(bundle->find(target), nullptr) << target;
  }
}

TEST(Bundle, SaysWhatIsWrongWithAFolder) {
  const test::Scratch folder;
  const auto missing = Bundle::load(folder.path("nowhere"));
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().find("nowhere"), std::string::npos);
  const auto empty = Bundle::load(folder.path(""));
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().find("index.html"), std::string::npos);
}

}  // namespace
}  // namespace interlace::monitor

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "common/app/config/document.hpp"
#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

namespace fs = std::filesystem;
using samples::kCell;

constexpr std::size_t kTenMegabytes = 10U << 20U;

/// A folder of this test, gone afterwards.
class Files : public testing::Test {
 protected:
  Files() {
    std::string name = (fs::temp_directory_path() / "interlace-config-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~Files() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

std::string message_of(const model::Result<LoadedCell, ConfigError>& result) {
  return result ? "accepted" : to_string(result.error());
}

TEST_F(Files, GoodFileIsRead) {
  EXPECT_TRUE(load_cell(write("cell.yaml", kCell)));
  EXPECT_TRUE(load_program(write("program.yaml", samples::kProgram), nullptr));
  EXPECT_TRUE(load_program(path("program.yaml"), {model::RobotName{"r1"}, model::RobotName{"r2"}}));
}

TEST_F(Files, MessagesNameTheFileAsGiven) {
  const auto file = write("cell.yaml", samples::replaced(kCell, "interlace: 1", "interlace: 9"));
  EXPECT_EQ(message_of(load_cell(file)).find(file + ":1:12: interlace: found \"9\""), 0U) << message_of(load_cell(file));
}

TEST_F(Files, MissingFile) {
  EXPECT_EQ(message_of(load_cell(path("none.yaml"))), path("none.yaml") + ": no such file");
  const auto program = load_program(path("none.yaml"), nullptr);
  ASSERT_FALSE(program);
  EXPECT_EQ(to_string(program.error()), path("none.yaml") + ": no such file");
}

TEST_F(Files, Directory) {
  EXPECT_EQ(message_of(load_cell(folder_.string())), folder_.string() + ": is a directory, expected a file");
}

TEST_F(Files, UnreadableFile) {
  fs::create_symlink("loop.yaml", folder_ / "loop.yaml");  // cannot be opened by anyone, root included
  EXPECT_EQ(message_of(load_cell(path("loop.yaml"))).find(path("loop.yaml") + ": cannot be read: "), 0U)
      << message_of(load_cell(path("loop.yaml")));
}

TEST_F(Files, ReadErrorIsTold) {
  const std::string unmapped = "/proc/self/mem";  // opens, but there is nothing at address 0
  EXPECT_EQ(message_of(load_cell(unmapped)).find(unmapped + ": cannot be read: "), 0U) << message_of(load_cell(unmapped));
}

TEST_F(Files, EndlessFileIsRefused) {
  EXPECT_EQ(message_of(load_cell("/dev/zero")).find("/dev/zero: larger than 1024 KiB"), 0U);
}

TEST_F(Files, TenMegabytesOfGarbageAreRefused) {
  const unsigned seed = 20261;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random{seed};
  std::string garbage(kTenMegabytes, '\0');
  for (auto& c : garbage) c = static_cast<char>(random());
  const auto file = write("garbage.yaml", garbage);
  const auto from_file = load_cell(file);
  const auto from_text = parse_cell(garbage, "garbage.yaml");
  const auto program = load_program(file, nullptr);
  EXPECT_EQ(message_of(from_file), file + ": larger than 1024 KiB; no cell or program needs that");
  EXPECT_FALSE(from_text);
  EXPECT_FALSE(program);
}

TEST(Document, ExactlyTheLargestSizeIsRead) {
  EXPECT_TRUE(parse_cell(kCell + std::string(kMaxFileSize - kCell.size(), '\n'), "cell.yaml"));
  EXPECT_FALSE(parse_cell(kCell + std::string(kMaxFileSize - kCell.size() + 1, '\n'), "cell.yaml"));
}

TEST(Document, EmptyText) {
  for (const char* text : {"", "\n\n", "# nothing\n", "---\n", "~"}) {
    const auto result = parse_cell(text, "cell.yaml");
    ASSERT_FALSE(result) << text;
    EXPECT_NE(message_of(result).find("expected a mapping with the keys interlace, units, cell"), std::string::npos) << message_of(result);
  }
}

TEST(Document, BinaryIsNoText) {
  EXPECT_EQ(message_of(parse_cell(std::string("ab\ncd\0ef", 8), "cell.yaml")),
            "cell.yaml:2:3: not a text file: this byte is no printable UTF-8 character");
  for (const std::string bad : {"\x7f", "\xff", "\x80", "\xc3", "\xe2\x82", "\xc0\x80", "\x1b[2J"}) {
    EXPECT_NE(message_of(parse_cell("interlace: " + bad, "cell.yaml")).find("not a text file"), std::string::npos);
  }
}

TEST(Document, CommentsMayBeInAnyLanguage) {
  EXPECT_TRUE(parse_cell("# Zelle für zwei Arme, 二台\n" + kCell, "cell.yaml"));
}

TEST(Document, BrokenYamlIsToldWithItsPlace) {
  const auto result = parse_cell("interlace: 1\nunits: {length: mm\ncell: x\n", "cell.yaml");
  ASSERT_FALSE(result);
  EXPECT_NE(message_of(result).find("not valid YAML"), std::string::npos) << message_of(result);
  EXPECT_GT(result.error().findings.at(0).line, 1);
}

TEST(Document, AnchorsAndAliasesAreRefused) {
  const auto result = parse_cell("interlace: &one 1\nother: *one\n", "cell.yaml");
  EXPECT_EQ(message_of(result), "cell.yaml:1:12: anchors and aliases are not allowed: write the value out");
  EXPECT_FALSE(parse_cell("a: &x [1]\n", "cell.yaml"));
  EXPECT_FALSE(parse_cell("a: &x {b: 1}\n", "cell.yaml"));
  EXPECT_FALSE(parse_cell("a: &x\n", "cell.yaml"));
}

TEST(Document, AliasBombIsRefusedAtOnce) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last + ", " + last + ", " + last + "]\n";
  }
  EXPECT_NE(message_of(parse_cell(bomb, "cell.yaml")).find("anchors and aliases"), std::string::npos);
}

TEST(Document, SecondDocumentIsRefused) {
  EXPECT_NE(message_of(parse_cell(kCell + "---\n" + kCell, "cell.yaml")).find("expected one YAML document"), std::string::npos);
}

class DepthBomb : public testing::TestWithParam<const char*> {};

TEST_P(DepthBomb, IsRefusedWithoutRecursion) {
  const std::string once = GetParam();
  std::string bomb = "a: ";
  if (once[0] == '-' || once[0] == '?') bomb.clear();
  while (bomb.size() + once.size() < kMaxFileSize) bomb += once;
  const auto result = parse_cell(bomb, "cell.yaml");
  ASSERT_FALSE(result);
  EXPECT_NE(message_of(result).find("nested more than 12 deep"), std::string::npos) << message_of(result);
}

INSTANTIATE_TEST_SUITE_P(All, DepthBomb, testing::Values("[", "{a: ", "- ", "? ", "[{a: ", "{? "));

// Reading that grew with the square of the file would not end within the time limit every test has.
TEST(Document, WideFilesAreReadToTheEnd) {
  std::string wide = "interlace: 1\nprogram: [";
  while (wide.size() < kMaxFileSize - 10) wide += "0,";
  wide += "0]\n";
  std::string keys = "interlace: 1\n";
  for (int i = 0; keys.size() < kMaxFileSize - 20; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  for (const auto& text : {wide, keys}) {
    EXPECT_FALSE(parse_program(text, "program.yaml", nullptr));
  }
}

}  // namespace
}  // namespace interlace::app

#include <gtest/gtest.h>

#include <ostream>
#include <random>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/programs.hpp"
#include "tests/e2e/scratch.hpp"

// Wrong files, read by every program that reads such files: it says what is wrong and where, ends with exit code 2, and starts nothing.
namespace interlace::test {
namespace {

/// A file made wrong, and what must be said about it.
struct BadFile {
  std::string name;
  std::string text;
  std::vector<std::string> said;  ///< besides the file's name
};
void PrintTo(const BadFile& file, std::ostream* out) {
  *out << file.name;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  if (at == std::string::npos) throw std::logic_error{"nothing to replace: " + what};
  return text.replace(at, what.size(), with);
}

constexpr std::size_t kTenMegabytes = 10'000'000;

std::string binary_garbage() {
  std::mt19937 engine{1};  // any garbage will do, the same each time
  std::string text(kTenMegabytes, '\0');
  for (char& c : text) c = static_cast<char>(engine());
  return text;
}

/// Garbage that could be YAML, deeper and deeper.
std::string yaml_garbage() {
  std::string text;
  while (text.size() < kTenMegabytes) text += "[{a: ";
  return text;
}

std::string colliding_starts() {
  CellText cell;
  cell.r2_start = "xyz: [380, 120, 300], rpy: [0, 0, 0]";
  return cell_text(cell);
}

std::vector<BadFile> bad_cells() {
  const std::string good = cell_text();
  return {
      {"unknown_key", replaced(good, "    base:", "    colour: red\n    base:"), {"colour", "unknown"}},
      {"missing_unit", replaced(good, "{length: mm, angle: deg}", "{length: mm}"), {"units", "angle"}},
      {"missing_units", replaced(good, "units: {length: mm, angle: deg}\n", ""), {"units"}},
      {"nan", replaced(good, "velocity: 500", "velocity: .nan"), {"robots[0].tcp.velocity", "nan"}},
      {"not_a_number", replaced(good, "velocity: 500", "velocity: fast"), {"robots[0].tcp.velocity", "fast"}},
      {"duplicate_robot", replaced(good, "name: r2", "name: r1"), {"robots[1].name", "r1"}},
      {"duplicate_key", replaced(good, "cell: fast", "cell: fast\ncell: other"), {"cell"}},
      {"starts_in_collision", colliding_starts(), {"robots[1].start", "in collision with robots[0].start", "mm"}},
      {"start_out_of_reach", replaced(good, "start: {xyz: [450, 250, 300]", "start: {xyz: [4500, 250, 300]"), {"robots[0].start"}},
      {"wrong_version", replaced(good, "interlace: 1", "interlace: 2"), {"interlace", "2", "expected 1"}},
      {"empty", "", {"expected"}},
      {"not_yaml", "cell: [1, 2", {"not valid YAML"}},
      {"binary_garbage", binary_garbage(), {}},
      {"yaml_garbage", yaml_garbage(), {}},
  };
}

std::vector<BadFile> bad_programs() {
  const std::string good = table_4_4();
  return {
      {"unknown_key", replaced(good, "move: linear,", "move: linear, speed: 3,"), {"program.r1[0]", "speed", "unknown"}},
      {"missing_unit", replaced(good, "{length: mm, angle: deg}", "{angle: deg}"), {"units", "length"}},
      {"nan", replaced(good, "[300, 250, 330]", "[300, .nan, 330]"), {"program.r1[0].to.xyz", "nan"}},
      {"unknown_move", replaced(good, "move: linear", "move: jump"), {"program.r1[0].move", "jump"}},
      {"empty_program", "interlace: 1\nunits: {length: mm, angle: deg}\nprogram: {}\n", {"empty program"}},
      {"empty_lists", "interlace: 1\nunits: {length: mm, angle: deg}\nprogram: {r1: [], r2: []}\n", {"empty program"}},
      {"wrong_version", replaced(good, "interlace: 1", "interlace: 17"), {"interlace", "17", "expected 1"}},
      {"empty", "", {"expected"}},
      {"binary_garbage", binary_garbage(), {}},
      {"yaml_garbage", yaml_garbage(), {}},
  };
}

std::string name_of(const ::testing::TestParamInfo<BadFile>& info) {
  return info.param.name;
}

/// Bad input, told on stderr with the file's name and line, and nothing else.
void expect_refusal(const std::vector<std::string>& arguments, const std::string& file, const std::vector<std::string>& said) {
  const Outcome o = run(arguments, 10s);
  EXPECT_EQ(o.exit_code, 2) << o;
  EXPECT_EQ(o.output, "") << arguments[0];
  EXPECT_NE(o.errors.find(file), std::string::npos) << "which file?\n" << o;
  for (const std::string& words : said) EXPECT_NE(o.errors.find(words), std::string::npos) << "not said: " << words << '\n' << o;
  EXPECT_LT(o.errors.size(), 20'000u) << "a flood";
  EXPECT_EQ(o.errors.find(" ready "), std::string::npos) << "something was started\n" << o;
}

class BadCell : public ::testing::TestWithParam<BadFile> {
 protected:
  Scratch scratch_;
  std::string program_ = scratch_.file("program.yaml", table_4_4());
};

TEST_P(BadCell, IsRefusedByEveryProgram) {
  const std::string cell = scratch_.file("cell.yaml", GetParam().text);
  const auto& said = GetParam().said;
  expect_refusal({kPlanner, cell}, cell, said);
  expect_refusal({kProxy, cell, "--robot", "r1"}, cell, said);
  expect_refusal({kSim, cell, program_}, cell, said);
  expect_refusal({kClient, "watch", "--cell", "fast", "--clearance", "--cell-file", cell}, cell, said);
  expect_refusal({kClient, "run", program_, "--cell", "fast", "--cell-file", cell}, cell, said);
}
INSTANTIATE_TEST_SUITE_P(Files, BadCell, ::testing::ValuesIn(bad_cells()), name_of);

class BadProgram : public ::testing::TestWithParam<BadFile> {
 protected:
  Scratch scratch_;
  std::string cell_ = scratch_.file("cell.yaml", cell_text());
};

// The client finds all of it before it asks for a planner: there is none here.
TEST_P(BadProgram, IsRefusedByEveryProgram) {
  const std::string program = scratch_.file("program.yaml", GetParam().text);
  expect_refusal({kSim, cell_, program}, program, GetParam().said);
  expect_refusal({kClient, "run", program, "--cell", "fast"}, program, GetParam().said);
}
INSTANTIATE_TEST_SUITE_P(Files, BadProgram, ::testing::ValuesIn(bad_programs()), name_of);

TEST(BadCall, MissingFilesAndFoldersAreNamed) {
  const Scratch scratch;
  const std::string cell = scratch.file("cell.yaml", cell_text());
  const std::string program = scratch.file("program.yaml", table_4_4());
  const std::string none = scratch.path("no-such.yaml");
  const std::string folder = scratch.path(".");
  for (const auto& [file, said] : {std::pair<std::string, std::string>{none, "no such file"}, {folder, "is a directory"}}) {
    expect_refusal({kPlanner, file}, file, {said});
    expect_refusal({kProxy, file, "--robot", "r1"}, file, {said});
    expect_refusal({kSim, file, program}, file, {said});
    expect_refusal({kSim, cell, file}, file, {said});
    expect_refusal({kClient, "run", file, "--cell", "fast"}, file, {said});
    expect_refusal({kClient, "watch", "--cell", "fast", "--clearance", "--cell-file", file}, file, {said});
  }
}

TEST(BadCall, AnUnknownRobotIsToldWithTheFileThatDoesNotHaveIt) {
  const Scratch scratch;
  const std::string cell = scratch.file("cell.yaml", cell_text());
  expect_refusal({kProxy, cell, "--robot", "r3"}, cell, {"--robot", "r3"});
  const std::string program = scratch.file("program.yaml", replaced(table_4_4(), "  r2:", "  r3:"));
  expect_refusal({kSim, cell, program}, program, {"unknown robot \"r3\"", "r1", "r2"});
}

TEST(BadCall, WrongOptionsAreExitCodeTwoEverywhere) {
  const Scratch scratch;
  const std::string cell = scratch.file("cell.yaml", cell_text());
  const std::vector<std::vector<std::string>> calls{
      {kPlanner},
      {kPlanner, cell, "--domain", "233"},
      {kPlanner, cell, "--domain", "-1"},
      {kPlanner, cell, "--strategy", "hope"},
      {kPlanner, cell, "--no-such-option"},
      {kPlanner, cell, "--log", "loud"},
      {kProxy, cell},
      {kProxy, cell, "--robot", "r1", "--seed", "x"},
      {kClient},
      {kClient, "dance"},
      {kClient, "run", "--cell", "fast"},
      {kClient, "status"},
      {kClient, "status", "--cell", "a/b"},
      {kClient, "send", "--cell", "fast", "r1", "linear", "1", "2", "3"},
      {kClient, "send", "--cell", "fast", "r1", "linear", "1", "2", "nan", "0", "0", "0"},
      {kClient, "send", "--cell", "fast", "r1", "hop", "1", "2", "3", "0", "0", "0"},
      {kClient, "watch", "--cell", "fast", "--clearance"},
  };
  for (const auto& call : calls) {
    const Outcome o = run(call, 10s);
    std::string line;
    for (const std::string& word : call) line += word + ' ';
    EXPECT_EQ(o.exit_code, 2) << line << '\n' << o;
    EXPECT_FALSE(o.errors.empty()) << line;
  }
}

TEST(BadCall, HelpAndVersionAreNoMistakes) {
  for (const std::string& program : {kPlanner, kProxy, kSim, kClient}) {
    const Outcome help = run({program, "--help"});
    EXPECT_EQ(help.exit_code, 0) << help;
    EXPECT_TRUE(help.says("Exit codes:")) << help;
    EXPECT_EQ(run({program, "--version"}).exit_code, 0);
  }
  for (const std::string command : {"run", "send", "status", "watch", "cancel", "stop"}) {
    const Outcome help = run({kClient, command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << help;
    EXPECT_TRUE(help.says("Example:") || command == "cancel" || command == "stop") << help;
  }
}

}  // namespace
}  // namespace interlace::test

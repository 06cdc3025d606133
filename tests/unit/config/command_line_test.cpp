#include "common/app/command_line.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace interlace::app {
namespace {

/// What a program with the common options makes of its arguments.
struct Outcome {
  std::optional<ExitCode> end;
  int domain = 0;
  LogLevel level = LogLevel::info;
  std::string out, err;
};

Outcome run(std::vector<const char*> arguments) {
  CLI::App app{"a program"};
  Outcome outcome;
  add_common(app);
  add_domain(app, outcome.domain);
  add_log_level(app, outcome.level);
  std::string cell;
  app.add_option("CELL", cell, "Cell file")->required();
  arguments.insert(arguments.begin(), "program");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome.end = parse(app, static_cast<int>(arguments.size()), arguments.data());
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override { unsetenv("INTERLACE_DOMAIN"); }
  void TearDown() override { unsetenv("INTERLACE_DOMAIN"); }
};

TEST_F(CommandLine, DefaultsGoOn) {
  const auto outcome = run({"cell.yaml"});
  EXPECT_FALSE(outcome.end);
  EXPECT_EQ(outcome.domain, 0);
  EXPECT_EQ(outcome.level, LogLevel::info);
}

TEST_F(CommandLine, DomainFromOptionThenEnvironment) {
  EXPECT_EQ(run({"cell.yaml", "--domain", "232"}).domain, 232);
  setenv("INTERLACE_DOMAIN", "17", 1);
  EXPECT_EQ(run({"cell.yaml"}).domain, 17);
  EXPECT_EQ(run({"cell.yaml", "--domain", "3"}).domain, 3);
}

TEST_F(CommandLine, WrongDomainIsBadInputWhereverItComesFrom) {
  for (const char* wrong : {"233", "-1", "zero", "1.5", ""}) {
    const auto outcome = run({"cell.yaml", "--domain", wrong});
    EXPECT_EQ(outcome.end, ExitCode::bad_input) << wrong;
    EXPECT_NE(outcome.err.find("--domain"), std::string::npos) << outcome.err;
  }
  setenv("INTERLACE_DOMAIN", "999", 1);
  EXPECT_EQ(run({"cell.yaml"}).end, ExitCode::bad_input);
}

TEST_F(CommandLine, LogLevel) {
  EXPECT_EQ(run({"cell.yaml", "--log", "debug"}).level, LogLevel::debug);
  EXPECT_EQ(run({"cell.yaml", "--log", "error"}).level, LogLevel::error);
  EXPECT_EQ(run({"cell.yaml", "--log", "loud"}).end, ExitCode::bad_input);
}

TEST_F(CommandLine, MissingAndUnknownArgumentsAreBadInput) {
  EXPECT_EQ(run({}).end, ExitCode::bad_input);
  const auto unknown = run({"cell.yaml", "--colour", "red"});
  EXPECT_EQ(unknown.end, ExitCode::bad_input);
  EXPECT_NE(unknown.err.find("--colour"), std::string::npos) << unknown.err;
}

TEST_F(CommandLine, HelpAndVersionAreOk) {
  const auto help = run({"--help"});
  EXPECT_EQ(help.end, ExitCode::ok);
  EXPECT_NE(help.out.find("INTERLACE_DOMAIN"), std::string::npos) << help.out;
  EXPECT_NE(help.out.find("130  stopped by SIGINT"), std::string::npos) << help.out;
  const auto asked = run({"--version"});
  EXPECT_EQ(asked.end, ExitCode::ok);
  EXPECT_EQ(asked.out, std::string{version()} + "\n");
}

}  // namespace
}  // namespace interlace::app

#include "common/app/logging.hpp"

#include <gtest/gtest.h>

#include <cctype>

namespace interlace::app {
namespace {

TEST(Logging, LineIsEventAndFields) {
  EXPECT_EQ(log_line("started", {}), "started");
  EXPECT_EQ(log_line("dispatched", {{"robot", "r1"}, {"attempt", 3}, {"start", 12.5}, {"late", false}}),
            "dispatched robot=r1 attempt=3 start=12.5 late=false");
}

TEST(Logging, AwkwardValuesStayOneReadableValue) {
  EXPECT_EQ(log_line("e", {{"text", "two words"}}), "e text=\"two words\"");
  EXPECT_EQ(log_line("e", {{"text", ""}}), "e text=\"\"");
  EXPECT_EQ(log_line("e", {{"text", "a\"b\\c"}}), "e text=\"a\\\"b\\\\c\"");
  EXPECT_EQ(log_line("e", {{"text", "line\nforged=1"}}), "e text=\"line\\nforged=1\"");
  EXPECT_EQ(log_line("e", {{"text", "\x1b[2J"}}), "e text=\"\\x1b[2J\"");
  EXPECT_EQ(log_line("e", {{"text", "für"}}), "e text=für");
}

TEST(Logging, GoesToStderrWithTimeLevelAndProgram) {
  testing::internal::CaptureStderr();
  start_logging("planner", LogLevel::info);
  log(LogLevel::debug, "unseen");
  log(LogLevel::info, "started", {{"cell", "a {} b"}});
  log(LogLevel::error, "lost");
  std::string text = testing::internal::GetCapturedStderr();
  for (auto& c : text) c = std::isdigit(static_cast<unsigned char>(c)) != 0 ? '#' : c;
  const std::string time = "####-##-##T##:##:##.######Z ";
  EXPECT_EQ(text, time + "info planner started cell=\"a {} b\"\n" + time + "error planner lost\n");
}

TEST(Logging, LevelsByName) {
  EXPECT_EQ(parse_log_level("warning"), LogLevel::warning);
  EXPECT_THROW((void)parse_log_level("loud"), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::app

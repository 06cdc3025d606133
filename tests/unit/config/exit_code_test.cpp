#include "common/app/exit_code.hpp"

#include <gtest/gtest.h>

namespace interlace::app {
namespace {

TEST(ExitCode, NumbersAreThoseScriptsRelyOn) {
  EXPECT_EQ(to_int(ExitCode::ok), 0);
  EXPECT_EQ(to_int(ExitCode::unserved), 1);
  EXPECT_EQ(to_int(ExitCode::bad_input), 2);
  EXPECT_EQ(to_int(ExitCode::collision), 3);
  EXPECT_EQ(to_int(ExitCode::unavailable), 4);
  EXPECT_EQ(to_int(ExitCode::fault), 5);
  EXPECT_EQ(to_int(ExitCode::interrupted), 130);
}

TEST(ExitCode, HelpNamesEachWithItsMeaning) {
  const std::string help = exit_code_help();
  for (const auto code : {ExitCode::ok, ExitCode::unserved, ExitCode::bad_input, ExitCode::collision, ExitCode::unavailable,
                          ExitCode::fault, ExitCode::interrupted}) {
    EXPECT_NE(help.find(std::to_string(to_int(code)) + "  " + meaning(code)), std::string::npos) << help;
  }
}

}  // namespace
}  // namespace interlace::app

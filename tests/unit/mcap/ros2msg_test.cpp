#include <gtest/gtest.h>

#include <stdexcept>

#include "common/idl/ros2msg.hpp"

namespace interlace::idl {
namespace {

TEST(Ros2Msg, PutsEverythingOfTheContractIntoRosWords) {
  const std::string idl = R"(
    module m {
    const long long FOREVER = 9;  // not a member of anything
    typedef string<65> Name;
    typedef sequence<Name, 32> Names;
    enum Colour { RED, GREEN };
    @final
    struct Point { double x; };
    @final
    struct All {
      unsigned long a; unsigned long long b; long c; long long d; boolean e;
      @key Name name;
      double joints[6];  // [rad]
      Colour colour;
      Colour other;
      sequence<Point, 16> points;
      Names names;
    };
    };)";
  EXPECT_EQ(ros2msg(idl, "All"),
            "uint32 RED=0\nuint32 GREEN=1\n"
            "uint32 a\nuint64 b\nint32 c\nint64 d\nbool e\nstring<=65 name\nfloat64[6] joints\nuint32 colour\nuint32 other\n"
            "interlace/Point[<=16] points\nstring<=65[<=32] names\n" +
                std::string(80, '=') + "\nMSG: interlace/Point\nfloat64 x\n");
}

TEST(Ros2Msg, DescribesEveryTypeOfTheContractWithEachDependencyOnce) {
  for (const char* name : {"Command", "CommandStatus", "Dispatch", "Execution", "Posture", "PlannerState"}) {
    EXPECT_NE(ros2msg(contract(), name).find("uint32 version\n"), std::string::npos) << name;
  }
  const std::string state = ros2msg(contract(), "PlannerState");
  EXPECT_NE(state.find("interlace/RobotStatus[<=128] robots\n"), std::string::npos);
  EXPECT_EQ(state.find("MSG: interlace/Point\n"), state.rfind("MSG: interlace/Point\n"));
}

TEST(Ros2Msg, SaysWhatItDoesNotUnderstand) {
  EXPECT_THROW((void)ros2msg("union X {};", "X"), std::invalid_argument);
  EXPECT_THROW((void)ros2msg("struct X { Unknown y; };", "X"), std::invalid_argument);
  EXPECT_THROW((void)ros2msg("struct X { double y", "X"), std::invalid_argument);
  EXPECT_THROW((void)ros2msg(contract(), "Nothing"), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::idl

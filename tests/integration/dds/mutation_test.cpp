#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <random>

#include "common/dds/convert.hpp"
#include "tests/integration/dds/raw_writer.hpp"
#include "tests/integration/dds/samples.hpp"

// Whatever bytes arrive: reading them neither throws nor crashes, and what is accepted is accepted again after a round through the model.
namespace interlace::test {
namespace {

constexpr int kMutants = 20'000;  // per message

Bytes mutate(Bytes bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>{0, n - 1}(random); };
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    switch (below(4)) {
      case 0: bytes.at(4 + below(bytes.size() - 4)) = static_cast<unsigned char>(below(256)); break;
      case 1: bytes.at(4 + below(bytes.size() - 4)) ^= static_cast<unsigned char>(1u << below(8)); break;
      case 2: {  // an aligned number becomes an extreme one
        const std::size_t at = 4 + 4 * below((bytes.size() - 4) / 4);
        const unsigned char value = below(2) == 0 ? 0xFF : 0;
        for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) bytes[i] = value;
        break;
      }
      default: bytes.resize(std::max<std::size_t>(8, below(bytes.size() + 16)), 0xAA); break;
    }
  }
  return bytes;
}

template <typename Message>
void survive(const Message& good, const std::string& owner) {
  using Wire = dds::WireOf<Message>;
  const auto seed = static_cast<unsigned>(std::chrono::system_clock::now().time_since_epoch().count());
  std::cout << "seed " << seed << '\n';
  std::mt19937 random{seed};
  const auto type = dds::make_type<Wire>();
  const Bytes bytes = serialised(dds::to_wire(good));
  int accepted = 0;
  for (int i = 0; i < kMutants; ++i) {
    Bytes mutant = mutate(bytes, random);
    eprosima::fastrtps::rtps::SerializedPayload_t payload{static_cast<std::uint32_t>(mutant.size())};
    std::memcpy(payload.data, mutant.data(), mutant.size());
    payload.length = static_cast<std::uint32_t>(mutant.size());
    Wire wire;
    ASSERT_TRUE(type->deserialize(&payload, &wire));
    const dds::Converted<Message> read = dds::from_wire(wire, owner);
    if (!read) {
      ASSERT_FALSE(read.error().empty());
      continue;
    }
    ++accepted;
    const dds::Converted<Message> again = dds::from_wire(dds::to_wire(*read), owner);
    ASSERT_TRUE(again) << again.error() << ", mutant " << i << " of seed " << seed;
  }
  std::cout << accepted << " of " << kMutants << " mutants are good messages\n";
  EXPECT_LT(accepted, kMutants);
}

TEST(Mutation, Command) {
  survive(linear_command(), kRobot.str());
  survive(joint_command(), kRobot.str());
  survive(replace_command(), kRobot.str());
}
TEST(Mutation, CommandStatus) {
  survive(status(), kRobot.str());
}
TEST(Mutation, Dispatch) {
  survive(execute(), kRobot.str());
  survive(heartbeat(), kRobot.str());
}
TEST(Mutation, Execution) {
  survive(execution(), kRobot.str());
}
TEST(Mutation, Posture) {
  survive(posture(), kRobot.str());
}
TEST(Mutation, PlannerState) {
  survive(planner_state("cell"), "cell");
}

}  // namespace
}  // namespace interlace::test

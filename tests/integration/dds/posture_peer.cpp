#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "common/dds/participant.hpp"
#include "common/dds/writer.hpp"
#include "tests/integration/dds/samples.hpp"

/// posture_peer DOMAIN CELL ROBOT SECONDS: writes postures at 100 Hz for at most SECONDS. Made to be killed.
int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: posture_peer DOMAIN CELL ROBOT SECONDS\n";
    return 2;
  }
  using Clock = std::chrono::steady_clock;
  const interlace::model::RobotName robot{argv[3]};
  interlace::dds::Participant participant{{static_cast<std::uint32_t>(std::stoul(argv[1])), "posture_peer"}};
  interlace::dds::Writer<interlace::dds::PostureMessage> writer{participant, interlace::dds::topics::posture(argv[2], robot)};
  const auto end = Clock::now() + std::chrono::seconds{std::stoi(argv[4])};
  for (auto next = Clock::now(); next < end; next += interlace::dds::kPosturePeriod) {
    if (!writer.write(interlace::test::posture(robot))) return 1;
    std::this_thread::sleep_until(next + interlace::dds::kPosturePeriod);
  }
  return 0;
}

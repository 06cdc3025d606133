#include "robot_proxy/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace interlace::proxy {
namespace {

using model::Duration;
using model::Instant;
using namespace std::chrono_literals;

LocalTime at(Duration d) {
  return LocalTime{d};
}

/// An echo with the given ways there, at the planner, and back; planner time is local time + `offset`.
Echo echo(LocalTime sent, Duration offset, Duration there, Duration stay, Duration back, std::uint64_t incarnation = 1) {
  Echo e;
  e.incarnation = incarnation;
  e.sent = sent;
  e.received = Instant{sent.time_since_epoch() + offset + there};
  e.answered = e.received + stay;
  e.returned = sent + there + stay + back;
  return e;
}

TEST(ClockOffset, KnowsNothingBeforeTheFirstEcho) {
  EXPECT_FALSE(ClockOffset{}.at(at(1s)));
}

TEST(ClockOffset, HalvesTheRoundTripWithoutThePlannersStay) {
  ClockOffset clock{0};
  clock.on_echo(echo(at(10s), 5s, 3ms, 40ms, 1ms), at(11s));
  const auto estimate = clock.at(at(11s));
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->offset, 5s + 1ms);
  EXPECT_EQ(estimate->uncertainty, 2ms + 1ns);
}

TEST(ClockOffset, UncertaintyGrowsWithAgeByTheDrift) {
  ClockOffset clock{50e-6};
  clock.on_echo(echo(at(0s), 5s, 0ns, 0ns, 0ns), at(0s));
  EXPECT_NEAR(static_cast<double>(clock.at(at(100s))->uncertainty.count()), 5e6, 2);
}

TEST(ClockOffset, ADelayedEchoNeverWorsensTheEstimate) {
  ClockOffset clock;
  clock.on_echo(echo(at(0s), 5s, 100us, 0ns, 100us), at(1ms));
  const auto before = clock.at(at(2s));
  clock.on_echo(echo(at(1s), 5s, 300ms, 0ns, 1us), at(2s));
  EXPECT_EQ(clock.at(at(2s))->offset, before->offset);
  EXPECT_EQ(clock.at(at(2s))->uncertainty, before->uncertainty);
}

TEST(ClockOffset, AnEquallyGoodFreshEchoTakesOver) {
  ClockOffset clock;
  clock.on_echo(echo(at(0s), 5s, 100us, 0ns, 100us), at(1ms));
  const auto before = clock.at(at(100s))->uncertainty;
  clock.on_echo(echo(at(100s), 5s, 100us, 0ns, 100us), at(100s));
  EXPECT_LT(clock.at(at(100s))->uncertainty, before);
}

TEST(ClockOffset, AnotherIncarnationForgetsEverything) {
  ClockOffset clock;
  clock.on_echo(echo(at(0s), 5s, 1us, 0ns, 1us, 1), at(1s));
  clock.on_incarnation(1);
  EXPECT_TRUE(clock.at(at(1s)));
  clock.on_incarnation(2);
  EXPECT_FALSE(clock.at(at(1s)));
  clock.on_echo(echo(at(2s), -3s, 10ms, 0ns, 10ms, 3), at(3s));
  EXPECT_EQ(clock.at(at(3s))->offset, -3s);
}

TEST(ClockOffset, ImpossibleEchoesAreIgnored) {
  ClockOffset clock;
  clock.on_echo(echo(at(1s), 5s, 1ms, -2ms, 1ms), at(2s));       // answered before it was received
  clock.on_echo(echo(at(1s), 5s, 1ms, 0ms, -3ms), at(2s));       // returned before it was sent
  clock.on_echo(echo(at(1s), 5s, -30ms, 100ms, -30ms), at(2s));  // stayed longer than the whole trip
  EXPECT_FALSE(clock.at(at(2s)));
}

TEST(ClockOffset, AnEchoThatContradictsTheKeptOneReplacesIt) {
  ClockOffset clock;
  clock.on_echo(echo(at(0s), 5s, 1us, 0ns, 1us), at(1s));
  clock.on_echo(echo(at(2s), 4s, 1ms, 0ns, 1ms), at(3s));  // one clock stood still for a second
  EXPECT_EQ(clock.at(at(3s))->offset, 4s);
}

TEST(ClockOffset, ForeverStaysForever) {
  const ClockEstimate ahead{-5s, 0ns};
  EXPECT_EQ(ahead.to_local(model::kForever), LocalTime::max());
  EXPECT_EQ(ahead.to_local(model::kEarliest), LocalTime::min() + 5s);
  const ClockEstimate behind{5s, 0ns};
  EXPECT_EQ(behind.to_planner(LocalTime::max()), model::kForever);
  EXPECT_EQ(behind.to_local(model::kEarliest), LocalTime::min());
  EXPECT_EQ(behind.to_planner(at(1s)), Instant{6s});
  EXPECT_EQ(behind.to_local(Instant{6s}), at(1s));
}

/// 200 pairs of clocks with rates within 50 ppm of each other, 500 echoes each over ways of 1 µs to 1 s: at every look the true offset
/// lies within estimate ± uncertainty. Tolerance 0.
TEST(ClockOffset, TheTruthLiesWithinTheUncertainty) {
  constexpr std::uint64_t kSeed = 20240;
  std::cout << "seed " << kSeed << '\n';
  std::mt19937_64 random{kSeed};
  std::uniform_real_distribution<double> unit{0, 1};
  const auto way = [&] { return Duration{static_cast<Duration::rep>(std::pow(10, 3 + 6 * unit(random)))}; };
  for (int pair = 0; pair < 200; ++pair) {
    const double rate = (2 * unit(random) - 1) * 50e-6;
    const Duration base{static_cast<Duration::rep>((2 * unit(random) - 1) * 1e15)};
    // Planner time at local time t, exact to the nanosecond it would be read with.
    const auto planner = [&](LocalTime t) {
      return Instant{t.time_since_epoch() + base +
                     Duration{static_cast<Duration::rep>(std::floor(rate * static_cast<double>(t.time_since_epoch().count())))}};
    };
    ClockOffset clock{50e-6};
    LocalTime now{};
    Duration least = Duration::max();
    for (int i = 0; i < 500; ++i) {
      now += way();
      Echo e;
      e.incarnation = 7;
      e.sent = now;
      const LocalTime received = e.sent + way();
      const LocalTime answered = received + way();
      e.received = planner(received);
      e.answered = planner(answered);
      e.returned = answered + way();
      now = e.returned + way();
      const auto before = clock.at(now);
      clock.on_echo(e, now);
      const auto after = clock.at(now);
      ASSERT_TRUE(after);
      if (before) {
        ASSERT_LE(after->uncertainty, before->uncertainty);
      }
      least = std::min(least, after->uncertainty);
      const LocalTime look = now + way();
      const auto estimate = clock.at(look);
      ASSERT_LE(std::chrono::abs(estimate->to_planner(look) - planner(look)), estimate->uncertainty) << "pair " << pair << " echo " << i;
    }
    EXPECT_LT(least, 50ms);  // the test would also pass with a useless estimate
  }
}

}  // namespace
}  // namespace interlace::proxy

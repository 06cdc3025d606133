#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "common/model/segment_distance.hpp"
#include "tests/support/arms.hpp"
#include "tests/unit/core/lossy_world.hpp"

/// The planner against a network that drops four messages of five, repeats and reorders: robots never touch, whatever is lost, and when the
/// network is mended every command is brought to one end.
namespace interlace::test {
namespace {

constexpr std::size_t kRuns = 300;
constexpr Duration kLook = 1ms;  // between looks at the clearance
constexpr double kTouch = 0;     // [m]
constexpr Instant kMended{8s};
constexpr Instant kLimit{120s};

/// Places on the line y = 0 between the two arms, of which both can never be taken at once, and a place aside for each.
model::MotionRequest outing(Seed& seed) {
  return line_to(pose_mm(seed.uniform(335, 365), seed.uniform(-10, 10), seed.uniform(190, 210)));
}
model::MotionRequest aside(std::size_t robot) {
  return line_to(pose_mm(robot == 0 ? 400 : 420, robot == 0 ? 250 : -250, 320));
}

std::shared_ptr<model::Cell> quick_cell(Seed& seed) {
  auto cell = experiment_cell();
  for (auto& robot : cell->robots) {
    robot.tcp.velocity = seed.uniform(0.3, 1.5);
    robot.tcp.acceleration = seed.uniform(1, 5);
    if (seed.chance(0.3)) robot.controller.speed_error = 0.02;
    if (seed.chance(0.3)) robot.controller = {0.02, 0.01, robot.controller.speed_error};
  }
  return cell;
}

model::Joints joints_at(const IdealProxy& proxy, Instant t) {
  const auto& done = proxy.executed();
  auto next = std::upper_bound(done.begin(), done.end(), t, [](Instant x, const Executed& e) { return x < e.start; });
  if (next == done.begin()) return proxy.robot().start;
  --next;
  return next->motion->joints(model::to_seconds(t - next->start) / next->stretch);
}

/// Least clearance of all the robots, looked at every millisecond from the motions really carried out.
double least_clearance(const std::vector<IdealProxy>& proxies, Instant end) {
  double least = 1e9;
  std::vector<std::vector<model::Capsule>> bodies(proxies.size());
  const auto any_moves = [&](Instant t) {
    return std::any_of(proxies.begin(), proxies.end(), [t](const IdealProxy& p) {
      return std::any_of(p.executed().begin(), p.executed().end(), [t](const Executed& e) { return e.start <= t && t <= e.end() + kLook; });
    });
  };
  for (Instant t{}; t < end; t += kLook) {
    if (!any_moves(t)) continue;
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      model::place_capsules(proxies[i].robot().model, proxies[i].robot().X_WB, joints_at(proxies[i], t), bodies[i]);
    }
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      for (std::size_t j = i + 1; j < proxies.size(); ++j) {
        for (const auto& a : bodies[i]) {
          for (const auto& b : bodies[j]) least = std::min(least, model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius);
        }
      }
    }
  }
  return least;
}

void expect_honest(const IdealProxy& proxy) {
  const auto& done = proxy.executed();
  for (std::size_t i = 0; i < done.size(); ++i) {
    EXPECT_GE(done[i].start, done[i].earliest) << done[i].id;
    EXPECT_LE(done[i].start, done[i].latest) << done[i].id;
    EXPECT_TRUE(i == 0 || done[i].start >= done[i - 1].end()) << done[i].id << " overlaps the motion before it";
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(done[i].id, done[j].id) << "carried out twice";
  }
}

struct Outcome {
  double least = 1e9;
  std::size_t motions = 0, sent = 0, lost = 0;
};

/// Nothing of a robot begins between its hold, as far as what was sent before may, and its resumption.
void expect_held(const LossyWorld& world, const IdealProxy& proxy, const std::string& hold, const std::string& resume) {
  constexpr core::Duration kSentBefore = 400ms;            // lead, and the longest window
  if (world.answered_at(hold) == model::kForever) return;  // all was done before
  for (const auto& done : proxy.executed()) {
    EXPECT_FALSE(done.start > world.answered_at(hold) + kSentBefore && done.start < world.answered_at(resume))
        << done.id << " began at " << model::to_seconds(done.start) << " s, held from " << model::to_seconds(world.answered_at(hold))
        << " s to " << model::to_seconds(world.answered_at(resume)) << " s";
  }
}

enum class Clients { submit, cancel, hold };

Outcome run_once(Seed& seed, const Network& network, Clients clients) {
  const auto cell = quick_cell(seed);
  core::PlannerOptions options;
  options.lead = 30ms;
  options.confirm = 50ms;
  options.start_tolerance = seed.chance(0.5) ? 20ms : 300ms;
  options.answer_timeout = 20ms;
  if (seed.chance(0.7)) options.posture_timeout = 600ms;
  LossyWorld world{cell, options, network, seed};
  for (std::size_t robot = 0; robot < cell->robots.size(); ++robot) {
    const std::size_t outings = 1 + seed.below(2);
    std::vector<model::CommandSubmitted> commands;
    for (std::size_t i = 0; i < 2 * outings; ++i) {
      model::CommandSubmitted c;
      c.robot = cell->robots[robot].name;
      c.id = model::CommandId{c.robot.str() + "-" + std::to_string(i)};
      c.motion = i % 2 == 0 ? outing(seed) : aside(robot);
      if (clients == Clients::cancel && i % 2 == 0 && seed.chance(0.3))
        world.cancel(c.id, c.robot, Instant{model::from_seconds(seed.uniform(0, 5))});
      commands.push_back(std::move(c));
    }
    world.submit(commands);
  }
  if (clients == Clients::hold) {
    for (const auto& robot : cell->robots) {
      const auto resume = [&world, &seed, robot = robot.name] {
        world.ask(model::ResumeRequested{model::CommandId{"resume-" + robot.str()}, robot},
                  world.now() + model::from_seconds(seed.uniform(0, 3)));
      };
      world.ask(model::HoldRequested{model::CommandId{"hold-" + robot.name.str()}, robot.name},
                Instant{model::from_seconds(seed.uniform(0, 5))}, resume);
    }
  }
  world.mend_network_at(kMended);
  world.run(kLimit);

  EXPECT_TRUE(world.all_final()) << "at " << model::to_seconds(world.now()) << " s";
  for (const auto& c : world.wanted()) {
    const auto said = world.finals().find(c.id.str());
    if (said == world.finals().end()) {
      ADD_FAILURE() << c.id.str() << " has no end";
      for (const auto& r : world.planner().state(world.now()).robots)
        std::printf("%s: %s %s\n", r.name.str().c_str(), to_string(r.mode), r.text.c_str());
    } else {
      EXPECT_EQ(said->second.size(), 1U) << c.id.str() << " has more than one end";
    }
  }
  Outcome outcome;
  for (const auto& proxy : world.proxies()) {
    expect_honest(proxy);
    const std::string name = proxy.robot().name.str();
    if (clients == Clients::hold) expect_held(world, proxy, "hold-" + name, "resume-" + name);
    outcome.motions += proxy.executed().size();
  }
  outcome.least = least_clearance(world.proxies(), world.now());
  EXPECT_GT(outcome.least, kTouch) << "robots touched";
  outcome.sent = world.sent();
  outcome.lost = world.lost();
  return outcome;
}

void run_many(std::uint64_t own_seed, const Network& network, Clients clients) {
  Seed seed{own_seed};
  Outcome all;
  const std::size_t runs = scaled(kRuns);
  for (std::size_t run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
    SCOPED_TRACE(::testing::Message() << "run " << run << " of seed " << seed.value());
    const Outcome one = run_once(seed, network, clients);
    all.least = std::min(all.least, one.least);
    all.motions += one.motions;
    all.sent += one.sent;
    all.lost += one.lost;
  }
  std::printf("%zu runs, %zu motions, %.0f %% of %zu messages lost; least clearance %.4f m\n", runs, all.motions,
              100.0 * static_cast<double>(all.lost) / static_cast<double>(all.sent), all.sent, all.least);
}

TEST(PlannerOnALossyNetwork, FourOfFiveMessagesLost) {
  run_many(81, {0.8, 0.3, 100ms}, Clients::submit);
}

TEST(PlannerOnALossyNetwork, HalfOfTheMessagesLostAndCommandsCancelled) {
  run_many(82, {0.5, 0.3, 60ms}, Clients::cancel);
}

TEST(PlannerOnALossyNetwork, NothingLostButEverythingReordered) {
  run_many(83, {0.0, 0.5, 200ms}, Clients::cancel);
}

TEST(PlannerOnALossyNetwork, HalfOfTheMessagesLostAndRobotsHeldAndResumed) {
  run_many(84, {0.5, 0.3, 60ms}, Clients::hold);
}

}  // namespace
}  // namespace interlace::test

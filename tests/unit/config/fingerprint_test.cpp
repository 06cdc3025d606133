#include "common/app/config/fingerprint.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using samples::kCell;
using samples::replaced;

std::uint64_t fingerprint_of(const std::string& text) {
  const auto loaded = parse_cell(text, "cell.yaml");
  EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.error()));
  return loaded ? loaded->fingerprint : 0;
}

TEST(Fingerprint, IsOfTheValuesNotOfTheText) {
  const auto original = fingerprint_of(kCell);
  EXPECT_EQ(fingerprint_of("# a comment\n" + kCell), original);
  EXPECT_EQ(fingerprint_of(replaced(kCell, "velocity: 100\n", "velocity: 1.0e2\n")), original);
  EXPECT_EQ(fingerprint_of(replaced(kCell, "fixtures: []\n", "")), original);
  EXPECT_EQ(fingerprint_of(replaced(kCell, "a1: 0", "a1: -0.0")), original);
  EXPECT_EQ(fingerprint(parse_cell(kCell, "other name")->cell), original);
}

TEST(Fingerprint, IsTheSameInOtherUnits) {
  const std::string rest = R"(
cell: small
robots:
  - name: r
    model: arm
    start: {joints: [0, 0, 0, 0, 0, 0]}
)";
  const auto millimetres = fingerprint_of("interlace: 1\nunits: {length: mm, angle: deg}" + rest + R"(
    base: {xyz: [100, 0, 0], rpy: [0, 0, 90]}
    tcp: {velocity: 100, acceleration: 300}
models: {arm: {kinematics: {type: opw, a1: 0, a2: 0, b: 0, c1: 290, c2: 260, c3: 270, c4: 90}, capsules: {chain: [112, 117, 100, 48]}}}
)");
  const auto metres = fingerprint_of("interlace: 1\nunits: {length: m, angle: rad}" + rest + R"(
    base: {xyz: [0.1, 0, 0], rpy: [0, 0, 1.570796326794896619]}
    tcp: {velocity: 0.1, acceleration: 0.3}
models: {arm: {kinematics: {type: opw, a1: 0, a2: 0, b: 0, c1: 0.29, c2: 0.26, c3: 0.27, c4: 0.09}, capsules: {chain: [0.112, 0.117, 0.1, 0.048]}}}
)");
  EXPECT_EQ(millimetres, metres);
}

TEST(Fingerprint, EveryChangeOfAValueChangesIt) {
  const std::vector<std::pair<std::string, std::string>> changes{{"cell: sample", "cell: other"},
                                                                 {"c1: 290", "c1: 290.001"},
                                                                 {"c4: 90", "c4: 91"},
                                                                 {"offsets: [0", "offsets: [0.001"},
                                                                 {"max: [170", "max: [171"},
                                                                 {"velocity: [200", "velocity: [201"},
                                                                 {"acceleration: [1000", "acceleration: [1001"},
                                                                 {"      acceleration: [1000, 1000, 1000, 1000, 1000, 1000]\n", ""},
                                                                 {"tool: {xyz: [0", "tool: {xyz: [1"},
                                                                 {"radius: 48", "radius: 49"},
                                                                 {"name: forearm", "name: lower"},
                                                                 {"to: [0, 0, 270]", "to: [0, 1, 270]"},
                                                                 {"[[base, hand]]", "[]"},
                                                                 {"name: r1", "name: r3"},
                                                                 {"base: {xyz: [0", "base: {xyz: [1"},
                                                                 {"start: {xyz: [450", "start: {xyz: [451"},
                                                                 {"joints: [0, 40", "joints: [0, 41"},
                                                                 {"velocity: 100\n", "velocity: 101\n"},
                                                                 {"acceleration: 200\n", "acceleration: 201\n"},
                                                                 {"angular_velocity: 90", "angular_velocity: 91"},
                                                                 {"angular_acceleration: 180", "angular_acceleration: 181"},
                                                                 {"start_latency: 0.02", "start_latency: 0.021"},
                                                                 {"start_jitter: 0.01", "start_jitter: 0.011"},
                                                                 {"speed_error: 0.001", "speed_error: 0.002"},
                                                                 {"path_error: 2", "path_error: 3"},
                                                                 {"resolution: 0.02", "resolution: 0.01"},
                                                                 {"margin: 5", "margin: 6"},
                                                                 {"strategy: direct", "strategy: event"},
                                                                 {"strategy: direct", "strategy: direct\n  budget: 0.5"},
                                                                 {"strategy: direct", "strategy: direct\n  promise: 0.5"},
                                                                 {"escapes: false", "escapes: true"},
                                                                 {"lead: 0.05", "lead: 0.06"},
                                                                 {"  start_tolerance: 0.03\n", ""},
                                                                 {"min: [100, -130", "min: [100, -131"},
                                                                 {"max: [600, 130, 900]", "max: [600, 130, 901]"},
                                                                 {"  zone: {min: [100, -130, 0], max: [600, 130, 900]}\n", ""}};
  std::set<std::uint64_t> seen{fingerprint_of(kCell)};
  for (const auto& [from, to] : changes) {
    EXPECT_TRUE(seen.insert(fingerprint_of(replaced(kCell, from, to))).second) << from << " → " << to;
  }
}

}  // namespace
}  // namespace interlace::app

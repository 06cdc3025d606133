#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/programs.hpp"
#include "tests/e2e/scratch.hpp"

// The contract of interlace-sim (DESIGN section 8), seen from outside: files, names, exit codes, numbers.
namespace interlace::test {
namespace {

using Vector = std::array<double, 3>;

/// One row of a trace.
struct Row {
  double t = 0;
  std::string robot, motion;
  Vector tcp{};
  std::array<double, 6> q{};
};

constexpr const char* kHeader = "t,robot,x,y,z,qw,qx,qy,qz,j1,j2,j3,j4,j5,j6,motion";

std::vector<Row> parse_trace(const std::string& text) {
  std::istringstream lines{text};
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, kHeader);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells{line};
    std::vector<std::string> v;
    for (std::string cell; std::getline(cells, cell, ',');) v.push_back(cell);
    if (v.size() == 15) v.emplace_back();  // an empty motion leaves nothing behind its comma
    if (v.size() != 16) {
      ADD_FAILURE() << "row " << rows.size() + 1 << ": " << line;
      return rows;
    }
    Row row;
    row.t = std::stod(v[0]);
    row.robot = v[1];
    for (std::size_t i = 0; i < 3; ++i) row.tcp[i] = std::stod(v[2 + i]);
    for (std::size_t i = 0; i < 6; ++i) row.q[i] = std::stod(v[9 + i]);
    row.motion = v[15];
    rows.push_back(std::move(row));
  }
  return rows;
}

// ---- a second opinion on the clearance, from the numbers in the trace and the dissertation's arm alone

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(double k, const Vector& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double norm(const Vector& a) {
  return std::sqrt(dot(a, a));
}

double point_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector d = b - a;
  const double s = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-18), 0.0, 1.0);
  return norm(p - (a + s * d));
}

/// The distance from a point that slides along one segment to the other segment is convex: its minimum is cornered by golden sections.
double segment_to_segment(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const auto at = [&](double s) { return point_to_segment(a0 + s * (a1 - a0), b0, b1); };
  double low = 0;
  double high = 1;
  while (high - low > 1e-6) {  // of a segment of 0.3 m: 0.3 µm
    const double inner = high - golden * (high - low);
    const double outer = low + golden * (high - low);
    if (at(inner) < at(outer)) {
      high = outer;
    } else {
      low = inner;
    }
  }
  return std::min({at(0), at((low + high) / 2), at(1)});
}

struct Base {
  double x, y, yaw;
};
constexpr std::array<double, 4> kRadii{0.112, 0.117, 0.100, 0.048};

/// Base, shoulder, elbow, wrist, TCP in the world: c1 = 290, c2 = 260, c3 = 270 mm, the TCP as the trace has it.
std::array<Vector, 5> chain(const Base& base, const Row& row) {
  const double yaw = base.yaw + row.q[0];
  const auto along = [&](double angle, double length) {
    return Vector{length * std::sin(angle) * std::cos(yaw), length * std::sin(angle) * std::sin(yaw), length * std::cos(angle)};
  };
  const Vector foot{base.x, base.y, 0};
  const Vector shoulder = foot + Vector{0, 0, 0.290};
  const Vector elbow = shoulder + along(row.q[1], 0.260);
  const Vector wrist = elbow + along(row.q[1] + row.q[2], 0.270);
  return {foot, shoulder, elbow, wrist, row.tcp};
}

double clearance(const std::array<Vector, 5>& a, const std::array<Vector, 5>& b) {
  double least = 1e9;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      least = std::min(least, segment_to_segment(a[i], a[i + 1], b[j], b[j + 1]) - kRadii[i] - kRadii[j]);
    }
  }
  return least;
}

struct Seen {
  double least = 1e9;      // [m]
  double below_zero = 0;   // [s]
  double worst_hand = 0;   // largest error of the distance from wrist to TCP [m]
  double last_motion = 0;  // when anything last moved [s]
};

Seen look_at(const std::vector<Row>& rows, const std::map<std::string, Base>& bases, double period) {
  Seen seen;
  std::map<std::string, std::array<Vector, 5>> now;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto arm = chain(bases.at(rows[i].robot), rows[i]);
    seen.worst_hand = std::max(seen.worst_hand, std::abs(norm(arm[4] - arm[3]) - 0.090));
    if (!rows[i].motion.empty()) seen.last_motion = rows[i].t;
    now[rows[i].robot] = arm;
    if (now.size() < bases.size() || (i + 1) % bases.size() != 0) continue;
    double least = 1e9;
    for (auto a = now.begin(); a != now.end(); ++a) {
      for (auto b = std::next(a); b != now.end(); ++b) least = std::min(least, clearance(a->second, b->second));
    }
    seen.least = std::min(seen.least, least);
    if (least <= 0) seen.below_zero += period;
  }
  return seen;
}

// ---- the experiments

struct Experiment {
  const char* name;
  double event;   ///< makespan not to be exceeded [s]
  double direct;  ///< makespan [s], to one decimal
  std::size_t commands;
};
void PrintTo(const Experiment& e, std::ostream* out) {
  *out << e.name;
}

class Experiments : public ::testing::TestWithParam<Experiment> {
 protected:
  [[nodiscard]] std::string cell() const { return deployed(std::string{GetParam().name} + "/cell.yaml"); }
  [[nodiscard]] std::string program() const { return deployed(std::string{GetParam().name} + "/program.yaml"); }

  Scratch scratch_;
};

const std::map<std::string, Base> kTwoRobots{{"r1", {0, 0.25, 0}}, {"r2", {0, -0.25, 0}}};

TEST_P(Experiments, EventIsFastAndNothingTouchesInAMillisecondTrace) {
  const std::string trace = scratch_.path("trace.csv");
  const std::string report = scratch_.path("report.json");
  const Outcome o =
      run({kSim, cell(), program(), "--strategy", "event", "--trace", trace, "--trace-period", "0.001", "--report", report}, 60s);
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto reports = nlohmann::json::parse(read_text(report));
  ASSERT_EQ(reports.size(), 1u);
  const auto& r = reports[0];
  EXPECT_EQ(r["strategy"], "event");
  EXPECT_EQ(r["completed"], GetParam().commands);
  EXPECT_EQ(r["collisions"], 0);
  EXPECT_LE(r["makespan_s"].get<double>(), GetParam().event);
  const auto rows = parse_trace(read_text(trace));
  ASSERT_GT(rows.size(), 2 * 1000 * r["makespan_s"].get<double>());
  EXPECT_NEAR(rows[2].t - rows[0].t, 0.001, 1e-9);
  const Seen seen = look_at(rows, kTwoRobots, 0.001);
  EXPECT_LT(seen.worst_hand, 1e-6) << "joints and TCP of the trace do not belong together";
  EXPECT_GT(seen.least, 0);
  EXPECT_NEAR(seen.least, r["min_clearance_m"].get<double>(), 0.0005) << "the report's own observer saw something else";
  EXPECT_NEAR(seen.last_motion, r["makespan_s"].get<double>(), 0.05);
}

TEST_P(Experiments, DirectTakesAsLongAsTheDissertationSaysAndCollides) {
  const std::string trace = scratch_.path("trace.csv");
  const std::string report = scratch_.path("report.json");
  const Outcome o = run({kSim, cell(), program(), "--strategy", "direct", "--trace", trace, "--report", report}, 60s);
  ASSERT_EQ(o.exit_code, 3) << o;
  EXPECT_TRUE(o.says("COLLISIONS")) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_NEAR(r["makespan_s"].get<double>(), GetParam().direct, 0.05);
  EXPECT_GT(r["collisions"], 0);
  EXPECT_LT(r["min_clearance_m"], 0);
  const Seen seen = look_at(parse_trace(read_text(trace)), kTwoRobots, 0.01);
  EXPECT_LT(seen.least, 0);
  EXPECT_GT(seen.below_zero, 1) << "a collision that the independent distance hardly sees";
}

TEST_P(Experiments, ZoneBlockingServesEverythingAndNothingTouches) {
  const std::string trace = scratch_.path("trace.csv");
  const std::string report = scratch_.path("report.json");
  const Outcome o = run({kSim, cell(), program(), "--strategy", "zone", "--trace", trace, "--report", report}, 60s);
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], GetParam().commands);
  EXPECT_GT(r["makespan_s"].get<double>(), GetParam().event) << "a whole zone for one robot at a time cannot be as fast";
  EXPECT_GT(look_at(parse_trace(read_text(trace)), kTwoRobots, 0.01).least, 0);
}

std::string name_of(const ::testing::TestParamInfo<Experiment>& experiment) {
  std::string name = experiment.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Dissertation, Experiments,
                         ::testing::Values(Experiment{"exp-4-1", 42.2, 37.7, 20}, Experiment{"exp-4-2", 29.3, 23.7, 16},
                                           Experiment{"exp-5-1", 42.8, 35.2, 20}),
                         name_of);

/// Dissertation table 4.7: 40.7 s with zone blocking. It does not tell the zone; ours is made from the reach of both arms.
TEST(Baselines, ZoneBlockingTakesAsLongOnExperiment42AsTheDissertationSays) {
  const Scratch scratch;
  const std::string report = scratch.path("report.json");
  const Outcome o =
      run({kSim, deployed("exp-4-2/cell.yaml"), deployed("exp-4-2/program.yaml"), "--strategy", "zone", "--report", report}, 60s);
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_GE(r["makespan_s"].get<double>(), 38.5);
  EXPECT_LE(r["makespan_s"].get<double>(), 41.5);
  EXPECT_EQ(r["collisions"], 0);
}

/// Dissertation section 4.5: the map of the end-effectors alone does not see the other links meet.
TEST(Baselines, MapsOfEndEffectorsAloneLetBodiesCollide) {
  for (const std::string experiment : {"exp-4-1", "exp-5-1"}) {
    const Scratch scratch;
    const std::string trace = scratch.path("trace.csv");
    const std::string report = scratch.path("report.json");
    const Outcome o = run({kSim, deployed(experiment + "/cell.yaml"), deployed(experiment + "/program.yaml"), "--strategy", "eef-map",
                           "--trace", trace, "--report", report},
                          60s);
    EXPECT_EQ(o.exit_code, 3) << experiment << '\n' << o;
    const auto r = nlohmann::json::parse(read_text(report)).at(0);
    EXPECT_GT(r["collisions"], 0) << experiment;
    EXPECT_LT(look_at(parse_trace(read_text(trace)), kTwoRobots, 0.01).least, 0) << experiment;
  }
}

// ---- files and exit codes

class Sim : public ::testing::Test {
 protected:
  Scratch scratch_;
  std::string cell_ = scratch_.file("cell.yaml", cell_text());
  std::string program_ = scratch_.file("program.yaml", table_4_4());
};

TEST_F(Sim, TraceHasARowPerRobotEveryTenMilliseconds) {
  const std::string trace = scratch_.path("trace.csv");
  const Outcome o = run({kSim, cell_, program_, "--trace", trace});
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto rows = parse_trace(read_text(trace));
  ASSERT_GT(rows.size(), 100u);
  ASSERT_EQ(rows.size() % 2, 0u);
  std::size_t moving = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].t, 0.01 * static_cast<double>(i / 2), 1e-9);
    EXPECT_EQ(rows[i].robot, i % 2 == 0 ? "r1" : "r2");
    moving += rows[i].motion.empty() ? 0 : 1;
  }
  EXPECT_GT(moving, 100u);
  EXPECT_NEAR(rows[0].tcp[0], 0.45, 1e-9);  // SI, world frame
  EXPECT_NEAR(rows[0].tcp[1], 0.25, 1e-9);
  EXPECT_NEAR(rows[1].tcp[1], -0.25, 1e-9);
}

TEST_F(Sim, ReportHasTheFieldsOfTheContract) {
  const std::string report = scratch_.path("report.json");
  ASSERT_EQ(run({kSim, cell_, program_, "--report", report}).exit_code, 0);
  const auto reports = nlohmann::json::parse(read_text(report));
  ASSERT_TRUE(reports.is_array());
  const auto& r = reports.at(0);
  for (const char* field : {"strategy", "makespan_s", "submitted", "completed", "rejected", "unserved", "escapes", "warnings", "collisions",
                            "min_clearance_m", "map_build_ms", "decision_ms", "commands"}) {
    EXPECT_TRUE(r.contains(field)) << field;
  }
  for (const char* field : {"count", "mean", "p50", "p99", "max"}) {
    EXPECT_TRUE(r["map_build_ms"].contains(field)) << field;
    EXPECT_TRUE(r["decision_ms"].contains(field)) << field;
  }
  ASSERT_EQ(r["commands"].size(), 8u);
  for (const char* field : {"id", "robot", "origin", "release_s", "start_s", "end_s", "delay_s", "reason"}) {
    EXPECT_TRUE(r["commands"][0].contains(field)) << field;
  }
  double first = 1e9;
  double last = 0;
  for (const auto& c : r["commands"]) {
    first = std::min(first, c["start_s"].get<double>());
    last = std::max(last, c["end_s"].get<double>());
  }
  EXPECT_NEAR(r["makespan_s"].get<double>(), last - first, 1e-6);
}

TEST_F(Sim, AllStrategiesWriteAFileEachAndOneReport) {
  const std::string report = scratch_.path("report.json");
  const Outcome o = run({kSim, cell_, program_, "--strategy", "all", "--trace", scratch_.path("trace.csv"), "--report", report});
  EXPECT_EQ(o.exit_code, 3) << "direct collides\n" << o;
  const auto reports = nlohmann::json::parse(read_text(report));
  ASSERT_GE(reports.size(), 2u);
  std::vector<std::string> strategies;
  for (const auto& r : reports) {
    strategies.push_back(r["strategy"]);
    const std::string trace = read_text(scratch_.path("trace." + strategies.back() + ".csv"));
    EXPECT_EQ(trace.substr(0, trace.find('\n')), kHeader) << strategies.back();
  }
  EXPECT_EQ(std::count(strategies.begin(), strategies.end(), "direct"), 1);
  EXPECT_EQ(std::count(strategies.begin(), strategies.end(), "event"), 1);
  EXPECT_TRUE(read_text(scratch_.path("trace.csv")).empty());
}

TEST_F(Sim, TheSameSeedTellsTheSameStoryAnotherSeedAnother) {
  CellText late;
  late.controller = "{start_latency: 0.02, start_jitter: 0.01, speed_error: 0.01}";
  const std::string cell = scratch_.file("late.yaml", cell_text(late));
  const auto trace_of = [&](const std::string& seed, const std::string& name) {
    const Outcome o = run({kSim, cell, program_, "--seed", seed, "--trace", scratch_.path(name)});
    EXPECT_EQ(o.exit_code, 0) << o;
    return read_text(scratch_.path(name));
  };
  const std::string once = trace_of("7", "a.csv");
  const std::string twice = trace_of("7", "b.csv");
  const std::string other = trace_of("8", "c.csv");
  ASSERT_FALSE(once.empty());
  EXPECT_TRUE(once == twice) << "two runs with one seed differ";
  EXPECT_FALSE(once == other) << "the seed changes nothing";
}

TEST_F(Sim, LatencyAndJitterTouchNothingForAnySeed) {
  for (int seed = 1; seed <= 10; ++seed) {
    const Outcome o =
        run({kSim, deployed("exp-4-2-latency/cell.yaml"), deployed("exp-4-2-latency/program.yaml"), "--seed", std::to_string(seed)});
    EXPECT_EQ(o.exit_code, 0) << "seed " << seed << '\n' << o;
  }
}

TEST_F(Sim, ACommandLeftUnservedIsExitCodeOne) {
  // r2 parks in the middle for good, r1 wants to go there.
  const std::string program = scratch_.file(
      "deadlock.yaml", program_text({"{move: linear, at: 3, to: {xyz: [350, 0, 200], rpy: [0, 0, 0]}}"}, {linear(350, 0, 200)}));
  const std::string report = scratch_.path("report.json");
  CellText nobody_escapes;
  nobody_escapes.escapes = false;
  const std::string cell = scratch_.file("nobody-escapes.yaml", cell_text(nobody_escapes));
  const Outcome o = run({kSim, cell, program, "--report", report});
  EXPECT_EQ(o.exit_code, 1) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], 1);
  EXPECT_EQ(r["unserved"], 1);
  EXPECT_EQ(r["collisions"], 0);
  EXPECT_EQ(r["commands"][1]["robot"], "r1");
  EXPECT_EQ(r["commands"][1]["reason"], "blocked");
  EXPECT_NE(r["commands"][1]["explanation"].get<std::string>().find("r2"), std::string::npos);
}

TEST_F(Sim, AnUnreachableTargetIsRejectedWithItsPlaceAndTheOthersGoOn) {
  const std::string program = scratch_.file(
      "far.yaml", program_text({linear(300, 250, 330), linear(300, 2000, 330), linear(400, 250, 330)}, {linear(300, -250, 330)}));
  const std::string report = scratch_.path("report.json");
  const Outcome o = run({kSim, cell_, program, "--report", report});
  EXPECT_EQ(o.exit_code, 1) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["submitted"], 4);
  EXPECT_EQ(r["completed"], 3);
  EXPECT_EQ(r["rejected"], 1);
  EXPECT_TRUE(o.says("out of reach")) << o;
  EXPECT_TRUE(o.says("% of the path")) << "where?\n" << o;
}

TEST_F(Sim, BadOptionsAreExitCodeTwo) {
  EXPECT_EQ(run({kSim}).exit_code, 2);
  EXPECT_EQ(run({kSim, cell_, program_, "--no-such-option"}).exit_code, 2);
  EXPECT_EQ(run({kSim, cell_, program_, "--trace-period", "0"}).exit_code, 2);
  const Outcome strategy = run({kSim, cell_, program_, "--strategy", "hope"});
  EXPECT_EQ(strategy.exit_code, 2);
  EXPECT_TRUE(strategy.says("hope") && strategy.says("event")) << strategy;
  const Outcome nowhere = run({kSim, cell_, program_, "--trace", scratch_.path("no/such/folder/trace.csv")});
  EXPECT_EQ(nowhere.exit_code, 2) << nowhere;
  EXPECT_TRUE(nowhere.says("cannot be written")) << nowhere;
}

TEST_F(Sim, HelpTellsTheExitCodes) {
  const Outcome o = run({kSim, "--help"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_TRUE(o.says("robots touched") && o.says("PROGRAM")) << o;
}

}  // namespace
}  // namespace interlace::test

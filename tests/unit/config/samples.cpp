#include "tests/unit/config/samples.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace interlace::app::samples {

const std::string kCell = R"(interlace: 1
units: {length: mm, angle: deg}
cell: sample
models:
  arm:
    kinematics:
      type: opw
      a1: 0
      a2: 0
      b: 0
      c1: 290
      c2: 260
      c3: 270
      c4: 90
      offsets: [0, 0, 0, 0, 0, 0]
      signs: [1, 1, 1, 1, 1, 1]
    joints:
      min: [-170, -90, -175, -180, -135, -360]
      max: [170, 180, 250, 180, 135, 360]
      velocity: [200, 200, 200, 300, 300, 400]
      acceleration: [1000, 1000, 1000, 1000, 1000, 1000]
    tool: {xyz: [0, 0, 0], rpy: [0, -90, 0]}
    capsules:
      - {name: base, link: 0, from: [0, 0, 0], to: [0, 0, 290], radius: 112}
      - {name: upper, link: 2, from: [0, 0, 0], to: [0, 0, 260], radius: 117}
      - {name: forearm, link: 3, from: [0, 0, 0], to: [0, 0, 270], radius: 100}
      - {name: hand, link: 6, from: [0, 0, -90], to: [0, 0, 0], radius: 48}
    self_collision: [[base, hand]]
robots:
  - name: r1
    model: arm
    base: {xyz: [0, 250, 0], rpy: [0, 0, 0]}
    start: {xyz: [450, 250, 300], rpy: [0, 0, 0], posture: {shoulder: front, elbow: up}}
    home: {joints: [0, 40, 94, 0, -44, 0]}
    tcp:
      velocity: 100
      acceleration: 200
      angular_velocity: 90
      angular_acceleration: 180
    controller: {start_latency: 0.02, start_jitter: 0.01, speed_error: 0.001, path_error: 2}
  - name: r2
    model: arm
    base: {xyz: [0, -250, 0], rpy: [0, 0, 0]}
    start: {xyz: [450, -250, 300], rpy: [0, 0, 0]}
    tcp: {velocity: 100, acceleration: 100}
fixtures: []
planning:
  resolution: 0.02
  margin: 5
  strategy: direct
  lead: 0.05
  start_tolerance: 0.03
  escapes: false
  zone: {min: [100, -130, 0], max: [600, 130, 900]}
)";

const std::string kToolCell = [] {
  const std::string tools = R"(tools:
  short:
    capsules:
      - {from: [0, 0, 0], to: [0, 0, 60], radius: 30}
  fork:
    capsules:
      - {from: [0, 0, 0], to: [0, 0, 100], radius: 20}
      - {from: [0, 50, 100], to: [0, 50, 200], radius: 10}
robots:
)";
  return replaced(replaced(kCell, "robots:\n", tools), "    controller:", "    holds: [short]\n    controller:");
}();

const std::string kProgram = R"(interlace: 1
units: {length: mm, angle: deg}
repeat: 2
program:
  r1:
    - {move: linear, to: {xyz: [300, 250, 330], rpy: [0, 0, 90]}}
    - {move: joint, to: {joints: [0, 40, 94, 0, -44, 180]}}
  r2:
    - move: linear
      to: {xyz: [300, -250, 330], rpy: [0, 0, 0]}
      velocity: 50
      acceleration: 60
      priority: 7
      at: 2.5
      deadline: 30
events:
  - {at: 4, hold: r1}
  - {at: 6.5, resume: r1}
  - {at: 1, cancel: r2, command: 2}
  - at: 5
    replace: r2
    by:
      - {move: joint, to: {joints: [0, 40, 94, 0, -44, 0]}, priority: -1}
)";

std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::invalid_argument("the sample does not contain: " + from);
  return text.substr(0, at) + to + text.substr(at + from.size());
}

std::vector<Finding> cell_findings(const std::string& text) {
  const auto result = parse_cell(text, "cell.yaml");
  return result ? std::vector<Finding>{} : result.error().findings;
}

std::vector<Finding> program_findings(const std::string& text) {
  const auto result = parse_program(text, "program.yaml", {model::RobotName{"r1"}, model::RobotName{"r2"}});
  return result ? std::vector<Finding>{} : result.error().findings;
}

void expect_only(const std::vector<Finding>& findings, const Broken& broken, const std::string& file) {
  SCOPED_TRACE(broken.name);
  ASSERT_EQ(findings.size(), 1U) << to_string(ConfigError{findings});
  const Finding& finding = findings.front();
  EXPECT_EQ(finding.file, file);
  EXPECT_EQ(finding.line, broken.line);
  EXPECT_GT(finding.column, 0);
  EXPECT_EQ(finding.key, broken.key);
  EXPECT_EQ(finding.found, broken.found);
  EXPECT_NE(finding.rule.find(broken.rule), std::string::npos) << finding.rule;
  const std::string text = to_string(finding);
  EXPECT_EQ(text.find(file + ":" + std::to_string(broken.line) + ":" + std::to_string(finding.column) + ": " +
                      (broken.key.empty() ? "found" : broken.key + ": ")),
            0U)
      << text;
  EXPECT_NE(text.find(broken.found), std::string::npos) << text;
  EXPECT_NE(text.find(broken.rule), std::string::npos) << text;
}

}  // namespace interlace::app::samples

#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "monitor/frame.hpp"

namespace interlace::test {

/// Experiment 4.2's two arms, 500 mm apart.
inline const std::string kTwoArms = R"(interlace: 1
units: {length: mm, angle: deg}
cell: two
models:
  arm4:
    kinematics: {type: opw, a1: 0, a2: 0, b: 0, c1: 290, c2: 260, c3: 270, c4: 90}
    tool: {xyz: [0, 0, 0], rpy: [0, -90, 0]}
    capsules:
      chain: [112, 117, 100, 48]
robots:
  - name: r1
    model: arm4
    base:  {xyz: [0, 250, 0], rpy: [0, 0, 0]}
    start: {xyz: [450, 250, 300], rpy: [0, 0, 0]}
    tcp:   {velocity: 100, acceleration: 100}
  - name: r2
    model: arm4
    base:  {xyz: [0, -250, 0], rpy: [0, 0, 0]}
    start: {xyz: [450, -250, 300], rpy: [0, 0, 0]}
    tcp:   {velocity: 100, acceleration: 100}
planning: {resolution: 0.02, margin: 0, strategy: event}
)";

/// The same, and what a test wants otherwise.
inline app::LoadedCell two_arms(const std::string& more = "") {
  auto cell = app::parse_cell(kTwoArms + more, "two.yaml");
  if (!cell) throw std::runtime_error{to_string(cell.error())};
  return std::move(*cell);
}

inline nlohmann::json parsed(const monitor::Frame& frame) {
  return nlohmann::json::parse(*frame.text);
}

/// The newest frame of a type; null when there is none.
inline nlohmann::json newest(const std::vector<monitor::Frame>& frames, const std::string& type) {
  nlohmann::json found;
  for (const auto& frame : frames) {
    if (auto json = parsed(frame); json["type"] == type) found = std::move(json);
  }
  return found;
}

}  // namespace interlace::test

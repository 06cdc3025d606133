#include "tests/e2e/cells.hpp"

#include <fmt/format.h>

namespace interlace::test {

namespace {

constexpr const char* kJoints = "{min: [-170, -90, -175, -180, -135, -360], max: [170, 180, 250, 180, 135, 360]}";

std::string arm(const std::string& name, const std::string& joints) {
  return fmt::format(R"(  {}:
    kinematics: {{type: opw, a1: 0, a2: 0, b: 0, c1: 290, c2: 260, c3: 270, c4: 90}}
    joints: {}
    tool: {{xyz: [0, 0, 0], rpy: [0, -90, 0]}}
    capsules: {{chain: [112, 117, 100, 48]}}
)",
                     name, joints);
}

std::string robot(const CellText& cell, const std::string& name, const std::string& arm_name, double y, const std::string& start) {
  return fmt::format("  - name: {}\n    model: {}\n    base: {{xyz: [0, {}, 0], rpy: [0, 0, 0]}}\n    start: {{{}}}\n", name, arm_name, y,
                     start) +
         fmt::format("    tcp: {{velocity: {}, acceleration: {}}}\n", cell.velocity, cell.acceleration) +
         (cell.controller.empty() ? "" : fmt::format("    controller: {}\n", cell.controller));
}

std::string commands(const std::string& name, const std::vector<std::string>& list) {
  if (list.empty()) return {};
  std::string text = fmt::format("  {}:\n", name);
  for (const std::string& command : list) text += fmt::format("    - {}\n", command);
  return text;
}

}  // namespace

std::string cell_text(const CellText& cell) {
  return fmt::format(R"(interlace: 1
units: {{length: mm, angle: deg}}
cell: {}
models:
)",
                     cell.name) +
         arm("arm4", kJoints) + (cell.r2_joints.empty() ? "" : arm("other", cell.r2_joints)) + "robots:\n" +
         robot(cell, "r1", "arm4", 250, "xyz: [450, 250, 300], rpy: [0, 0, 0]") +
         robot(cell, "r2", cell.r2_joints.empty() ? "arm4" : "other", -250, cell.r2_start) +
         (cell.fixtures.empty() ? "" : "fixtures:\n" + cell.fixtures) +
         fmt::format("planning: {{resolution: 0.01, margin: 0, strategy: {}, escapes: {}}}\n", cell.strategy, cell.escapes);
}

std::string linear(double x, double y, double z) {
  return fmt::format("{{move: linear, to: {{xyz: [{}, {}, {}], rpy: [0, 0, 0]}}}}", x, y, z);
}

std::string program_text(const std::vector<std::string>& r1, const std::vector<std::string>& r2, int repeat) {
  return fmt::format("interlace: 1\nunits: {{length: mm, angle: deg}}\nrepeat: {}\nprogram:\n", repeat) + commands("r1", r1) +
         commands("r2", r2);
}

std::string table_4_4(int repeat) {
  return program_text({linear(300, 250, 330), linear(350, 0, 200), linear(350, -51, 200), linear(400, 250, 330)},
                      {linear(300, -250, 330), linear(350, 0, 200), linear(350, 51, 200), linear(400, -250, 330)}, repeat);
}

}  // namespace interlace::test

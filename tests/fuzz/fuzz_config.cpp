#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"

namespace {

using namespace interlace;

void require(bool truth) {
  if (!truth) std::abort();
}

void check(const app::ConfigError& error) {
  require(!error.findings.empty());
  for (const auto& finding : error.findings) require(!finding.rule.empty() && app::to_string(finding).find('\n') == std::string::npos);
}

void check(const model::Cell& cell) {
  require(!cell.robots.empty() && model::is_valid_name(cell.name));
  for (const auto& robot : cell.robots) {
    require(model::is_valid_name(robot.name.str()) && robot.start.allFinite() && robot.home.allFinite() && robot.X_WB.matrix().allFinite());
    require(std::isfinite(robot.tcp.velocity) && robot.tcp.velocity > 0 && std::isfinite(robot.tcp.acceleration) &&
            robot.tcp.acceleration > 0);
    require(!model::joint_outside_limits(robot.model.joints, robot.start));
  }
  for (const auto& fixture : cell.fixtures) require(model::is_valid_name(fixture.name) && fixture.X_WO.matrix().allFinite());
}

void check(const model::Program& program) {
  require(program.size() > 0);
  for (const auto& entry : program.robots) require(model::is_valid_name(entry.first.str()));
}

}  // namespace

/// Any text is refused with reasons or gives a value that keeps the promises of its type.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  const auto cell = app::parse_cell(text, "cell.yaml");
  if (cell) {
    check(cell->cell);
  } else {
    check(cell.error());
  }
  const auto program = app::parse_program(text, "program.yaml", nullptr);
  if (program) {
    check(*program);
  } else {
    check(program.error());
  }
  return 0;
}

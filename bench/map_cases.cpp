#include "bench/map_cases.hpp"

#include <stdexcept>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"
#include "simulator/virtual_cell.hpp"
#include "tests/support/arms.hpp"

namespace interlace::bench {

MapCases c12_c22() {
  MapCases cases;
  cases.name = "C12xC22";
  cases.cell = test::experiment_cell();
  const auto reach_in = [&](std::size_t robot, double y) {
    const model::Robot& r = cases.cell->robots[robot];
    const auto there = model::plan_motion(r, r.start, test::line_to(test::pose_mm(300, y, 330))).value();
    return model::plan_motion(r, there.to(), test::line_to(test::pose_mm(350, 0, 200))).value();
  };
  cases.maps.push_back({reach_in(0, 250), reach_in(1, -250)});
  return cases;
}

MapCases maps_of(const std::string& cells, const std::string& folder, const std::string& program) {
  const std::string base = cells + "/" + folder + "/";
  auto cell = app::load_cell(base + "cell.yaml");
  if (!cell) throw std::runtime_error{to_string(cell.error())};
  MapCases cases;
  cases.name = folder + " " + program;
  cases.cell = std::make_shared<const model::Cell>(std::move(cell->cell));
  const auto steps = app::load_program(base + program + ".yaml", cases.cell.get());
  if (!steps) throw std::runtime_error{to_string(steps.error())};
  sim::VirtualOptions options;
  options.observe = false;
  options.check_period = 1;
  options.on_map = [&](const core::SampledMotionPtr& commanded, const core::SampledMotionPtr& moving) {
    cases.maps.push_back({commanded->motion(), moving->motion()});
  };
  (void)sim::run_virtual(cases.cell, *steps, options);
  return cases;
}

}  // namespace interlace::bench

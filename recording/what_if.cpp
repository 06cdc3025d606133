#include "recording/what_if.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "simulator/virtual_cell.hpp"

namespace interlace::recording {
namespace {

/// Mean and largest delay of the commands of clients [s].
std::pair<double, double> delays(const app::RunReport& report) {
  double sum = 0;
  double largest = 0;
  std::size_t count = 0;
  for (const app::CommandRow& row : report.commands) {
    if (row.escape || !row.start) continue;
    sum += row.delay;
    largest = std::max(largest, row.delay);
    ++count;
  }
  return {count == 0 ? 0 : sum / static_cast<double>(count), largest};
}

}  // namespace

app::RunReport what_if(std::shared_ptr<const model::Cell> cell, const PlannerLife& life, const std::string& strategy) {
  std::vector<sim::Release> releases;
  model::Instant origin{};
  for (const model::PlannerCall& call : life.calls) {
    const auto* request = std::get_if<model::ClientRequest>(&call.event);
    if (request == nullptr) continue;
    if (releases.empty()) origin = call.now;
    releases.push_back({model::Instant{call.now - origin}, *request});
  }
  sim::VirtualOptions options;
  options.strategy = strategy;
  return sim::run_virtual(std::move(cell), releases, options);
}

std::string comparison(const std::vector<std::pair<std::string, app::RunReport>>& runs) {
  std::string text;
  const auto row = [&](const char* name, const std::function<std::string(const app::RunReport&)>& value) {
    text += fmt::format("{:<20}", name);
    for (const auto& run : runs) text += fmt::format("{:>22}", value(run.second));
    text += '\n';
  };
  text += fmt::format("{:<20}", "");
  for (const auto& run : runs) text += fmt::format("{:>22}", run.first);
  text += '\n';
  row("strategy", [](const auto& r) { return r.strategy; });
  row("completed", [](const auto& r) { return fmt::format("{} of {}", r.completed, r.submitted); });
  row("makespan [s]", [](const auto& r) { return fmt::format("{:.2f}", r.makespan); });
  row("mean delay [s]", [](const auto& r) { return fmt::format("{:.2f}", delays(r).first); });
  row("largest delay [s]", [](const auto& r) { return fmt::format("{:.2f}", delays(r).second); });
  row("escapes", [](const auto& r) { return fmt::format("{}", r.escapes); });
  row("least clearance [mm]",
      [](const auto& r) { return r.least_clearance ? fmt::format("{:.1f}", 1e3 * *r.least_clearance) : std::string{"-"}; });
  row("collisions", [](const auto& r) { return r.collisions ? fmt::format("{}", *r.collisions) : std::string{"-"}; });
  return text;
}

}  // namespace interlace::recording

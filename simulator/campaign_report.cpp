#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "simulator/campaign.hpp"

namespace interlace::sim {

namespace {

nlohmann::json to_json(const Nearest& n) {
  if (!std::isfinite(n.clearance)) return nullptr;
  return {{"clearance_m", n.clearance}, {"t_s", n.t}, {"link_a", n.link_a}, {"link_b", n.link_b}};
}

std::string millimetres(const Nearest& n) {
  return std::isfinite(n.clearance) ? fmt::format("{:.2f}", 1e3 * n.clearance) : "-";
}

}  // namespace

std::string command_line(const CampaignReport& report, const CampaignRun& run) {
  // One command is asked for, so that this one program is run, with as many as it has.
  return fmt::format("interlace-campaign --cells {} --seed {} --per-robot {} --strategy {}{} --commands 1", report.paths[run.cell],
                     run.seed, report.per_robot, report.strategy,
                     report.resolution ? fmt::format(" --resolution {}", *report.resolution) : "");
}

std::string summary(const CampaignReport& report, std::size_t most) {
  constexpr const char* kLine = "{:<20} {:>8} {:>7} {:>8} {:>9} {:>8} {:>8} {:>4} {:>7} {:>9} {:>8} {:>10} {:>11} {:>11} {:>9} {:>7}\n";
  std::string text =
      fmt::format(fmt::runtime(kLine), "cell", "programs", "failing", "commands", "completed", "rejected", "unserved", "lost", "escapes",
                  "fruitless", "warnings", "collisions", "nearest mm", "map ms mean", "map p99", "virt h");
  text.insert(text.size() - 1, "  real s");
  CampaignRow all;
  for (const CampaignRow& r : report.rows) {
    text += fmt::format(fmt::runtime(kLine), r.cell, r.programs, r.failing, r.total.submitted, r.total.completed, r.total.rejected,
                        r.total.unserved, r.total.lost, r.total.escapes, r.total.fruitless_rounds, r.total.warnings, r.collisions,
                        millimetres(r.nearest), fmt::format("{:.2f}", r.map_build.mean), fmt::format("{:.2f}", r.map_build.p99),
                        fmt::format("{:.2f}", r.virtual_time / 3600));
    text.insert(text.size() - 1, fmt::format("{:>8.1f}", r.real_time));
    all.programs += r.programs;
    all.failing += r.failing;
    all.total.submitted += r.total.submitted;
    all.total.completed += r.total.completed;
    all.collisions += r.collisions;
    all.virtual_time += r.virtual_time;
  }
  text += fmt::format(
      "{}: {} of {} commands completed in {} programs, {} programs failing, {} collisions; {:.1f} h of virtual time in {:.1f} s\n",
      report.strategy, all.total.completed, all.total.submitted, all.programs, all.failing, all.collisions, all.virtual_time / 3600,
      report.real_time);
  std::size_t shown = 0;
  for (const CampaignRun& run : report.failing) {
    if (shown++ == most) break;
    text += '\n' + command_line(report, run) + '\n';
    if (run.collisions > 0) {
      text += fmt::format("  {} collisions, deepest {} mm at {:.3f} s: {} with {}\n", run.collisions, millimetres(run.nearest),
                          run.nearest.t, run.nearest.link_a, run.nearest.link_b);
    }
    for (const std::string& complaint : run.verdict.complaints) text += "  " + complaint + '\n';
  }
  if (report.failing.size() > most)
    text += fmt::format("\nand {} more failing programs, all in the report\n", report.failing.size() - most);
  return text;
}

nlohmann::json to_json(const CampaignReport& report) {
  nlohmann::json cells = nlohmann::json::array();
  for (const CampaignRow& r : report.rows) {
    cells.push_back({{"cell", r.cell},
                     {"robots", r.robots},
                     {"programs", r.programs},
                     {"failing", r.failing},
                     {"submitted", r.total.submitted},
                     {"completed", r.total.completed},
                     {"rejected", r.total.rejected},
                     {"unserved", r.total.unserved},
                     {"lost", r.total.lost},
                     {"contradicted", r.total.contradicted},
                     {"escapes", r.total.escapes},
                     {"fruitless_rounds", r.total.fruitless_rounds},
                     {"warnings", r.total.warnings},
                     {"collisions", r.collisions},
                     {"nearest", to_json(r.nearest)},
                     {"map_build_ms",
                      {{"count", r.map_build.count},
                       {"mean", r.map_build.mean},
                       {"p50", r.map_build.p50},
                       {"p99", r.map_build.p99},
                       {"max", r.map_build.max}}},
                     {"virtual_s", r.virtual_time},
                     {"real_s", r.real_time}});
  }
  nlohmann::json failing = nlohmann::json::array();
  for (const CampaignRun& run : report.failing) {
    failing.push_back({{"cell", report.rows[run.cell].cell},
                       {"seed", run.seed},
                       {"command", command_line(report, run)},
                       {"collisions", run.collisions},
                       {"nearest", to_json(run.nearest)},
                       {"complaints", run.verdict.complaints}});
  }
  return {{"strategy", report.strategy},
          {"per_robot", report.per_robot},
          {"resolution_s", report.resolution ? nlohmann::json(*report.resolution) : nlohmann::json(nullptr)},
          {"stopped", report.stopped},
          {"real_s", report.real_time},
          {"cells", std::move(cells)},
          {"failing", std::move(failing)}};
}

}  // namespace interlace::sim

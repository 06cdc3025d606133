#pragma once

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/programs.hpp"
#include "tests/support/domain.hpp"

namespace interlace::test {

/// A cell of real processes on one DDS domain. Everything it started is gone with it; when the test has failed, their logs are printed.
class RunningCell {
 public:
  /// Starts nothing yet. `name` is the cell's, as in `file`.
  RunningCell(std::uint32_t domain, std::string name, std::string file) : domain_(domain), name_(std::move(name)), file_(std::move(file)) {}
  ~RunningCell();
  RunningCell(const RunningCell&) = delete;
  RunningCell& operator=(const RunningCell&) = delete;

  /// Starts (again) the planner, a proxy, both, from the cell's file or another.
  Process& start_planner(const std::vector<std::string>& more = {});
  Process& start_proxy(const std::string& robot, const std::string& file = {});
  /// Planner and the proxies of r1 and r2; true once the planner knows both robots.
  [[nodiscard]] bool start(const std::vector<std::string>& planner_options = {});
  /// True once the planner has come to know `robot` for the `times`-th time.
  [[nodiscard]] bool knows(const std::string& robot, std::size_t times = 1);

  /// Starts `interlace SUBCOMMAND --cell NAME --domain N …`; arguments[0] is the sub-command.
  Process& client(std::vector<std::string> arguments);
  /// The same, to its end.
  [[nodiscard]] Outcome ask(std::vector<std::string> arguments, std::chrono::milliseconds patience = kPatience);
  /// Starts `interlace send` of a linear command to (x, y, z) [mm] with the tool turned as at the start.
  Process& send(const std::string& robot, const std::string& id, const std::array<int, 3>& xyz, const std::vector<std::string>& more = {});
  /// Starts an observer of the clearance; it writes `report` when it is told to end.
  Process& watch(const std::string& report);

  /// Starts the monitor on a free port and returns the address of its page once it is served; empty when it is not.
  [[nodiscard]] std::string start_monitor(const std::vector<std::string>& more = {});

  [[nodiscard]] Process& planner() { return *planner_; }
  [[nodiscard]] Process& monitor() { return *monitor_; }
  [[nodiscard]] Process& proxy(const std::string& robot) { return *proxies_.at(robot); }
  [[nodiscard]] std::uint32_t domain() const { return domain_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  Process& keep(std::vector<std::string> arguments);

  std::uint32_t domain_;
  std::string name_;
  std::string file_;
  std::vector<std::unique_ptr<Process>> processes_;  // all of them, in the order of their start
  Process* planner_ = nullptr;
  Process* monitor_ = nullptr;
  std::map<std::string, Process*> proxies_;
};

}  // namespace interlace::test

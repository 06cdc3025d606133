#include "tests/e2e/running_cell.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace interlace::test {

namespace {

/// The end of a long text.
std::string tail(const std::string& text) {
  constexpr std::size_t kMost = 6000;
  return text.size() <= kMost ? text : "…" + text.substr(text.size() - kMost);
}

}  // namespace

RunningCell::~RunningCell() {
  if (!::testing::Test::HasFailure()) return;
  for (const auto& process : processes_) {
    std::cout << "---- ";
    for (const std::string& argument : process->arguments()) std::cout << argument << ' ';
    const auto exit_code = process->wait(std::chrono::milliseconds{0});
    std::cout << (exit_code ? "ended with " + std::to_string(*exit_code) : "is running") << '\n'
              << tail(process->output()) << tail(process->errors());
  }
}

Process& RunningCell::keep(std::vector<std::string> arguments) {
  return *processes_.emplace_back(std::make_unique<Process>(std::move(arguments), true));
}

Process& RunningCell::start_planner(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{kPlanner, file_, "--domain", std::to_string(domain_)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  planner_ = &keep(std::move(arguments));
  return *planner_;
}

Process& RunningCell::start_proxy(const std::string& robot, const std::string& file) {
  Process& proxy = keep({kProxy, file.empty() ? file_ : file, "--robot", robot, "--domain", std::to_string(domain_)});
  proxies_[robot] = &proxy;
  return proxy;
}

bool RunningCell::start(const std::vector<std::string>& planner_options) {
  start_planner(planner_options);
  start_proxy("r1");
  start_proxy("r2");
  return knows("r1") && knows("r2");
}

bool RunningCell::knows(const std::string& robot, std::size_t times) {
  return planner_->logs("robot_known robot=" + robot, kPatience, times);
}

Process& RunningCell::client(std::vector<std::string> arguments) {
  std::vector<std::string> all{kClient, arguments.at(0), "--cell", name_, "--domain", std::to_string(domain_)};
  all.insert(all.end(), arguments.begin() + 1, arguments.end());
  return keep(std::move(all));
}

Outcome RunningCell::ask(std::vector<std::string> arguments, std::chrono::milliseconds patience) {
  return outcome(client(std::move(arguments)), patience);
}

Process& RunningCell::send(const std::string& robot, const std::string& id, const std::array<int, 3>& xyz,
                           const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"send", "--id", id};
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {robot, "linear"});
  for (const int value : xyz) arguments.push_back(std::to_string(value));
  arguments.insert(arguments.end(), 3, "0");
  return client(std::move(arguments));
}

std::string RunningCell::start_monitor(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{kMonitor, file_, "--domain", std::to_string(domain_), "--port", "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  monitor_ = &keep(std::move(arguments));
  if (!monitor_->logs(" url=", kPatience)) return {};
  const std::string log = monitor_->errors();
  const auto begin = log.find(" url=") + 5;
  return log.substr(begin, log.find('\n', begin) - begin);
}

Process& RunningCell::watch(const std::string& report) {
  return client({"watch", "--clearance", "--cell-file", file_, "--report", report});
}

}  // namespace interlace::test

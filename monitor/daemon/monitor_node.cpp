#include "monitor/daemon/monitor_node.hpp"

#include <utility>

#include "common/app/logging.hpp"

namespace interlace::monitor {

using app::log;
using app::LogLevel;

MonitorNode::Link::Link(dds::Participant& participant, const std::string& cell, const model::RobotName& robot)
    : commands(participant, dds::topics::command(cell, robot)),
      statuses(participant, dds::topics::command_status(cell, robot)),
      dispatches(participant, dds::topics::dispatch(cell, robot)),
      executions(participant, dds::topics::execution(cell, robot)),
      postures(participant, dds::topics::posture(cell, robot)) {}

MonitorNode::MonitorNode(app::LoadedCell cell, std::uint32_t domain, const ServerOptions& server, Bundle bundle,
                         std::optional<std::uint32_t> ros2_domain)
    : cell_(std::move(cell)),
      view_(cell_, Clock::now()),
      participant_({domain, "interlace-monitor " + cell_.cell.name}),
      states_(participant_, dds::topics::planner_state(cell_.cell.name)),
      ros2_(ros2_domain ? std::make_unique<Ros2Publisher>(cell_.cell, *ros2_domain) : nullptr),
      server_(server, std::move(bundle), [this](ViewerId viewer, const ViewerRequest& request) {
        asked_.note(viewer, request);
        wait_.wake();
      }) {
  wait_.attach(states_);
  for (const model::Robot& robot : cell_.cell.robots) {
    Link& link = *links_.emplace_back(std::make_unique<Link>(participant_, cell_.cell.name, robot.name));
    for (dds::ReaderBase* reader :
         std::initializer_list<dds::ReaderBase*>{&link.commands, &link.statuses, &link.dispatches, &link.executions, &link.postures}) {
      wait_.attach(*reader);
    }
  }
  log(LogLevel::info, "ready",
      {{"cell", cell_.cell.name}, {"robots", cell_.cell.robots.size()}, {"domain", domain}, {"url", server_.url()}});
}

void MonitorNode::stop() {
  stopping_ = true;
  wait_.wake();
}

void MonitorNode::run() {
  while (!stopping_) {
    (void)wait_.until(next_pose_);
    take_all();
    if (asked_.answer(view_, server_)) wait_.wake();
    if (const auto now = Clock::now(); now >= next_pose_) {
      show(now);
      next_pose_ = std::max(next_pose_ + LiveView::kPosePeriod, now);
    }
  }
  log(LogLevel::info, "stopped", {{"viewers", server_.viewers()}});
}

void MonitorNode::take_all() {
  const auto now = Clock::now();
  states_.take([&](model::PlannerState&& m) { view_.on_state(m, now); });
  for (auto& link : links_) {
    link->commands.take([&](dds::CommandMessage&& m) { view_.on_command(m); });
    link->dispatches.take([&](dds::DispatchMessage&& m) { view_.on_dispatch(m, now); });
    link->postures.take([&](dds::PostureMessage&& m) { view_.on_posture(m, now); });
    link->statuses.take([&](dds::StatusMessage&& m) { view_.on_status(m, now); });
    link->executions.take([&](dds::ExecutionMessage&& m) { view_.on_execution(m, now); });
  }
}

void MonitorNode::show(Clock::time_point now) {
  view_.advance(now);
  if (ros2_) ros2_->show(view_.picture(), now);
  auto events = view_.take_events();
  if (server_.viewers() == 0) return;
  for (Frame& event : events) server_.broadcast(std::move(event));
  server_.broadcast(view_.pose());
}

}  // namespace interlace::monitor

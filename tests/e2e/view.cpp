#include "tests/e2e/view.hpp"

#include <algorithm>
#include <set>

namespace interlace::test {

View::Link::Link(dds::Participant& participant, const std::string& cell, const std::string& robot)
    : statuses(participant, dds::topics::command_status(cell, model::RobotName{robot})),
      executions(participant, dds::topics::execution(cell, model::RobotName{robot})),
      postures(participant, dds::topics::posture(cell, model::RobotName{robot})) {}

View::View(std::uint32_t domain, const std::string& cell)
    : participant_({domain, "bystander"}), states_(participant_, dds::topics::planner_state(cell)) {
  wait_.attach(states_);
  for (const char* robot : {"r1", "r2"}) {
    Link& link = *links_.emplace_back(std::make_unique<Link>(participant_, cell, robot));
    wait_.attach(link.statuses);
    wait_.attach(link.executions);
    wait_.attach(link.postures);
  }
}

bool View::until(const std::function<bool()>& holds, std::chrono::milliseconds patience) {
  const auto deadline = dds::Wait::Clock::now() + patience;
  for (;;) {
    take();
    if (holds()) return true;
    if (dds::Wait::Clock::now() >= deadline) return false;
    (void)wait_.until(std::min(deadline, dds::Wait::Clock::now() + 100ms));  // `holds` may look at what does not come over DDS
  }
}

void View::take() {
  states_.take([&](model::PlannerState&& m) { planner_ = std::move(m); });
  for (auto& link : links_) {
    link->executions.take([&](dds::ExecutionMessage&& m) { executions_.push_back(std::move(m.report)); });
    link->statuses.take([&](dds::StatusMessage&& m) { statuses_.push_back(std::move(m.status)); });
    link->postures.take([&](dds::PostureMessage&& m) { postures_[m.posture.robot.str()] = std::move(m); });
  }
}

std::size_t View::queued(const std::string& robot) const {
  if (!planner_) return 0;
  for (const auto& r : planner_->robots) {
    if (r.name.str() == robot) return r.queued;
  }
  return 0;
}

const model::CommandStatus* View::status(const std::string& id) const {
  const auto found = std::find_if(statuses_.rbegin(), statuses_.rend(), [&](const auto& s) { return s.id.str() == id; });
  return found == statuses_.rend() ? nullptr : &*found;
}

bool View::reached(const std::string& id, model::CommandState state) const {
  return std::any_of(statuses_.begin(), statuses_.end(), [&](const auto& s) { return s.id.str() == id && s.state == state; });
}

std::size_t View::executions(model::ExecutionState state, const std::string& id) const {
  std::set<std::pair<model::CommandId, model::Instant>> events;  // a proxy may say it again, then with the same time
  for (const auto& e : executions_) {
    if (e.state == state && (id.empty() || e.id.str() == id)) events.emplace(e.id, e.at);
  }
  return events.size();
}

const dds::PostureMessage* View::posture(const std::string& robot) const {
  const auto found = postures_.find(robot);
  return found == postures_.end() ? nullptr : &found->second;
}

bool View::moving(const std::string& robot) const {
  const auto* seen = posture(robot);
  return seen != nullptr && seen->posture.moving;
}

bool View::stands_at(const std::string& robot, const model::Vector3& p_WTcp) const {
  const auto* seen = posture(robot);
  return seen != nullptr && !seen->posture.moving && (seen->posture.X_WT.translation() - p_WTcp).norm() < 1e-6;
}

}  // namespace interlace::test

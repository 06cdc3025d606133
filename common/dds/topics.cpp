#include "common/dds/topics.hpp"

#include <stdexcept>

namespace interlace::dds::topics {
namespace {

void require_name(const char* what, const std::string& text) {
  if (!model::is_valid_name(text)) {
    throw std::invalid_argument{std::string{what} + " '" + text + "': a name is 1 to 64 letters, digits, '_', '-', '.' or ':'"};
  }
}

template <typename Message>
Topic<Message> of_robot(const std::string& cell, const model::RobotName& robot, const char* kind) {
  require_name("cell", cell);
  require_name("robot", robot.str());
  return {cell + "/" + robot.str() + "/" + kind, robot.str()};
}

}  // namespace

Topic<CommandMessage> command(const std::string& cell, const model::RobotName& robot) {
  return of_robot<CommandMessage>(cell, robot, "command");
}
Topic<StatusMessage> command_status(const std::string& cell, const model::RobotName& robot) {
  return of_robot<StatusMessage>(cell, robot, "command_status");
}
Topic<DispatchMessage> dispatch(const std::string& cell, const model::RobotName& robot) {
  return of_robot<DispatchMessage>(cell, robot, "dispatch");
}
Topic<ExecutionMessage> execution(const std::string& cell, const model::RobotName& robot) {
  return of_robot<ExecutionMessage>(cell, robot, "execution");
}
Topic<PostureMessage> posture(const std::string& cell, const model::RobotName& robot) {
  return of_robot<PostureMessage>(cell, robot, "posture");
}
Topic<model::PlannerState> planner_state(const std::string& cell) {
  require_name("cell", cell);
  return {cell + "/planner_state", cell};
}
Topic<model::PlannerJournal> planner_journal(const std::string& cell) {
  require_name("cell", cell);
  return {cell + "/planner_journal", cell};
}

}  // namespace interlace::dds::topics

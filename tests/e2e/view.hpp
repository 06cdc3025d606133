#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "tests/e2e/programs.hpp"

namespace interlace::test {

/// What a bystander on the domain hears of the cell with r1 and r2: the test's own eyes, for conditions to wait for.
class View {
 public:
  View(std::uint32_t domain, const std::string& cell);

  /// Listens until `holds` or the end of `patience`; whether it holds.
  [[nodiscard]] bool until(const std::function<bool()>& holds, std::chrono::milliseconds patience = kPatience);

  /// Newest state of the planner; of the newest planner when there were several.
  [[nodiscard]] const std::optional<model::PlannerState>& planner() const { return planner_; }
  [[nodiscard]] std::size_t queued(const std::string& robot) const;

  /// Newest status of a command, null when nothing was said of it.
  [[nodiscard]] const model::CommandStatus* status(const std::string& id) const;
  [[nodiscard]] bool reached(const std::string& id, model::CommandState state) const;
  /// All statuses heard, in order.
  [[nodiscard]] const std::vector<model::CommandStatus>& statuses() const { return statuses_; }

  /// How often robots came to `state`, answers given again not counted; of command `id` alone, when given.
  [[nodiscard]] std::size_t executions(model::ExecutionState state, const std::string& id = {}) const;

  /// Newest posture, null when the robot was not heard.
  [[nodiscard]] const dds::PostureMessage* posture(const std::string& robot) const;
  [[nodiscard]] bool moving(const std::string& robot) const;
  /// It does not move and its TCP is within a micrometre of `p_WTcp` [m].
  [[nodiscard]] bool stands_at(const std::string& robot, const model::Vector3& p_WTcp) const;

 private:
  void take();

  struct Link {
    Link(dds::Participant& participant, const std::string& cell, const std::string& robot);
    dds::Reader<dds::StatusMessage> statuses;
    dds::Reader<dds::ExecutionMessage> executions;
    dds::Reader<dds::PostureMessage> postures;
  };
  dds::Participant participant_;
  dds::Reader<model::PlannerState> states_;
  std::vector<std::unique_ptr<Link>> links_;
  dds::Wait wait_;
  std::optional<model::PlannerState> planner_;
  std::vector<model::CommandStatus> statuses_;
  std::vector<model::ExecutionReported> executions_;
  std::map<std::string, dds::PostureMessage> postures_;
};

}  // namespace interlace::test

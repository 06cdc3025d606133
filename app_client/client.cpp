#include "app_client/client.hpp"

#include <algorithm>
#include <stdexcept>

namespace interlace::client {

const char* to_string(SubmitError e) {
  switch (e) {
    case SubmitError::unknown_robot: return "the cell has no such robot";
    case SubmitError::bad_id: return "an id is 1 to 64 letters, digits, '_', '-', '.' or ':'";
    case SubmitError::id_in_use: return "the id was used before";
  }
  return "?";
}

/// The way to and from the queue of one robot.
struct Client::Link {
  Link(dds::Participant& participant, const std::string& cell, const model::RobotName& robot)
      : commands(participant, dds::topics::command(cell, robot)), statuses(participant, dds::topics::command_status(cell, robot)) {}

  dds::Writer<dds::CommandMessage> commands;
  dds::Reader<dds::StatusMessage> statuses;
};

Client::Client(ClientOptions options)
    : options_(std::move(options)), ledger_(options_.patience), participant_({options_.domain, "interlace client " + options_.name}) {
  if (!model::is_valid_name(options_.name)) throw std::invalid_argument{"client name '" + options_.name + "' is no valid name"};
  (void)dds::topics::planner_state(options_.cell);  // throws for a cell that cannot be
}

Client::~Client() = default;

void Client::listen() {
  if (states_) return;
  states_.emplace(participant_, dds::topics::planner_state(options_.cell));
  wait_.attach(*states_);
}

bool Client::hear_planner(LocalTime deadline, const std::function<bool()>& give_up) {
  listen();
  (void)spin_until(deadline, [&] { return planner_ || (give_up && give_up()); });
  return planner_.has_value();
}

bool Client::connect(LocalTime deadline, const std::function<bool()>& give_up) {
  listen();
  connecting_ = true;
  if (planner_) add_links();
  const auto connected = [this] { return planner_ && links_open(); };
  (void)spin_until(deadline, [&] { return connected() || (give_up && give_up()); });
  return connected();
}

bool Client::links_open() const {
  return std::all_of(links_.begin(), links_.end(), [](const auto& entry) {
    return entry.second->commands.matched() > 0 && entry.second->statuses.counters().writers > 0;
  });
}

void Client::add_links() {
  for (const model::RobotStatus& robot : planner_->robots) {
    auto& link = links_[robot.name];
    if (link) continue;
    link = std::make_unique<Link>(participant_, options_.cell, robot.name);
    wait_.attach(link->statuses);
  }
}

model::Result<model::CommandId, SubmitError> Client::submit(const model::RobotName& robot, const model::MotionRequest& motion, int priority,
                                                            std::optional<double> deadline) {
  return submit(model::CommandSubmitted{model::CommandId{make_id("cmd")}, robot, motion, priority, deadline});
}

model::Result<model::CommandId, SubmitError> Client::submit(const model::CommandSubmitted& command) {
  if (links_.count(command.robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  if (!model::is_valid_name(command.id.str())) return model::unexpected(SubmitError::bad_id);
  if (!ledger_.submit(command)) return model::unexpected(SubmitError::id_in_use);
  return command.id;
}

model::Result<model::CommandId, SubmitError> Client::cancel(const model::RobotName& robot, const model::CommandId& id) {
  if (links_.count(robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  if (!model::is_valid_name(id.str())) return model::unexpected(SubmitError::bad_id);
  ledger_.cancel(robot, id);
  return id;
}

model::Result<model::CommandId, SubmitError> Client::stop(const model::RobotName& robot) {
  if (links_.count(robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  model::CommandId id{make_id("stop")};
  (void)ledger_.stop({id, robot});  // the id was never used
  return id;
}

model::Result<model::CommandId, SubmitError> Client::hold(const model::RobotName& robot) {
  if (links_.count(robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  model::CommandId id{make_id("hold")};
  (void)ledger_.hold({id, robot});  // the id was never used
  return id;
}

model::Result<model::CommandId, SubmitError> Client::resume(const model::RobotName& robot) {
  if (links_.count(robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  model::CommandId id{make_id("resume")};
  (void)ledger_.resume({id, robot});  // the id was never used
  return id;
}

model::Result<model::CommandId, SubmitError> Client::replace(const model::RobotName& robot,
                                                             const std::vector<model::CommandSubmitted>& commands) {
  if (links_.count(robot) == 0) return model::unexpected(SubmitError::unknown_robot);
  for (const auto& command : commands) {
    if (command.robot != robot) return model::unexpected(SubmitError::unknown_robot);
    if (!model::is_valid_name(command.id.str())) return model::unexpected(SubmitError::bad_id);
  }
  model::CommandId id{make_id("replace")};
  if (!ledger_.replace({id, robot, commands})) return model::unexpected(SubmitError::id_in_use);
  return id;
}

void Client::follow(const model::RobotName& robot) {
  auto& reader = postures_[robot];
  if (reader) return;
  reader = std::make_unique<dds::Reader<dds::PostureMessage>>(participant_, dds::topics::posture(options_.cell, robot));
  wait_.attach(*reader);
}

bool Client::spin_until(LocalTime deadline, const std::function<bool()>& done) {
  for (;;) {
    const LocalTime now = dds::Wait::Clock::now();
    step(now);
    if (done()) return true;
    if (now >= deadline) return false;
    (void)wait_.until(std::min(deadline, ledger_.next_due().value_or(deadline)));
  }
}

std::optional<Answer> Client::wait_for(const model::CommandId& id, LocalTime deadline) {
  (void)spin_until(deadline, [&] {
    const Answer* answer = find(id);
    return !answer || model::is_final(answer->status.state);
  });
  const Answer* answer = find(id);
  return answer ? std::optional{*answer} : std::nullopt;
}

bool Client::planner_alive() const {
  // The first state of a planner that lives can come before DDS tells that it does.
  return states_ && (states_->counters().alive > 0 || (planner_ && now_ - planner_heard_ <= dds::kPlannerStatePeriod));
}

void Client::step(LocalTime now) {
  now_ = now;
  if (states_) states_->take([&](model::PlannerState&& state) { take_state(std::move(state), now); });
  for (auto& [robot, link] : links_) {
    link->statuses.take([&](dds::StatusMessage&& m) { ledger_.on_status(m.planner_incarnation, m.status, now); });
  }
  for (auto& [robot, reader] : postures_) {
    reader->take([&](dds::PostureMessage&& m) {
      if (on_posture_) on_posture_(m, now);
    });
  }
  call_back();
  send_due(now);
  call_back();
}

void Client::take_state(model::PlannerState&& state, LocalTime now) {
  if (!ledger_.on_planner(state.incarnation, now)) return;
  replaced_ = replaced_ || (planner_ && planner_->incarnation != state.incarnation);
  planner_ = std::move(state);
  planner_heard_ = now;
  if (connecting_) add_links();
}

void Client::send_due(LocalTime now) {
  for (const Request& request : ledger_.due(now)) {
    const auto& robot = std::visit([](const auto& r) -> const model::RobotName& { return r.robot; }, request);
    const auto& id = std::visit([](const auto& r) -> const model::CommandId& { return r.id; }, request);
    auto& writer = links_.at(robot)->commands;
    if (writer.write({request, options_.name})) continue;
    // What no planner would take is refused here; anything else is sent again in time.
    if (!writer.last_refusal().empty()) ledger_.refuse(id, writer.last_refusal());
  }
}

void Client::call_back() {
  for (const Answer& answer : ledger_.take_news()) {
    if (on_answer_) on_answer_(answer);
  }
}

}  // namespace interlace::client

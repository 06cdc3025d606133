#include "app_client/program_run.hpp"

#include <algorithm>

namespace interlace::client {

namespace {

constexpr std::chrono::seconds kPlannerSilence{10};  // longer than a planner needs to be restarted by hand or by its supervisor
constexpr std::chrono::milliseconds kLook{500};      // how often standstill and silence are asked for

LocalDuration local(double seconds) {
  return std::chrono::duration_cast<LocalDuration>(std::chrono::duration<double>{seconds});
}

}  // namespace

ProgramRun::ProgramRun(Client& client, std::vector<PlannedCommand> plan, ProgramRunOptions options, OnChange on_change)
    : client_(client), plan_(std::move(plan)), options_(options), on_change_(std::move(on_change)) {
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    index_[plan_[i].command.id] = i;
    waiting_[plan_[i].command.robot].push_back(i);
  }
  client_.on_answer([this](const Answer& answer) { on_answer(answer); });
}

ProgramRun::~ProgramRun() {
  client_.on_answer(nullptr);
}

app::ReportCollector& ProgramRun::collector(model::Instant origin) {
  if (!collector_) {
    collector_.emplace(origin);
    for (const auto& planned : plan_) collector_->on_submitted(planned.command.id, planned.command.robot, planned.release);
    for (const auto& status : early_escapes_) collector_->on_status(status);
  }
  return *collector_;
}

void ProgramRun::on_answer(const Answer& answer) {
  changed_ = LocalTime::clock::now();
  const auto found = index_.find(answer.status.id);
  const double t = std::chrono::duration<double>(changed_ - start_).count();
  if (found == index_.end()) {
    // Escapes for commands of others belong to another run.
    if (!answer.status.escape || index_.count(answer.status.serves) == 0) return;
    if (collector_) {
      collector_->on_status(answer.status);
    } else {
      early_escapes_.push_back(answer.status);
    }
    if (on_change_) on_change_(nullptr, answer, t);
    return;
  }
  const PlannedCommand& planned = plan_[found->second];
  if (answer.told) {
    collector(answer.status.submitted - model::from_seconds(planned.release)).on_status(answer.status);
  } else if (collector_) {
    collector_->on_status(answer.status);
  }
  if (on_change_) on_change_(&planned, answer, t);
}

void ProgramRun::release(LocalTime now) {
  if (giving_up_) return;
  for (auto& [robot, commands] : waiting_) {
    while (!commands.empty() && client_.open(robot) < options_.window && now >= start_ + local(plan_[commands.front()].release)) {
      // The ids are new and the robots were checked; if the planner is now another one without this robot, the run ends as planner_lost.
      (void)client_.submit(plan_[commands.front()].command);
      commands.pop_front();
      ++released_;
    }
  }
}

LocalTime ProgramRun::next_release() const {
  LocalTime next = LocalTime::max();
  for (const auto& [robot, commands] : waiting_) {
    if (!commands.empty() && client_.open(robot) < options_.window) next = std::min(next, start_ + local(plan_[commands.front()].release));
  }
  return next;
}

bool ProgramRun::stalled(LocalTime now) {
  if (options_.stalled_after <= 0) return false;
  const auto& robots = client_.planner()->robots;
  const bool moving = std::any_of(robots.begin(), robots.end(), [](const auto& r) { return r.mode == model::RobotMode::moving; });
  if (moving || client_.open() == 0) changed_ = now;  // nothing on its way: the next release is being waited for
  return now - changed_ > local(options_.stalled_after);
}

bool ProgramRun::planner_lost(LocalTime now) {
  if (client_.planner_alive()) planner_seen_ = now;
  return client_.planner_replaced() || now - planner_seen_ > kPlannerSilence;
}

void ProgramRun::give_up() {
  giving_up_ = true;
  // The last first, so that none moves up and starts while those before it are given up.
  for (auto planned = plan_.rbegin(); planned != plan_.rend(); ++planned) {
    const Answer* answer = client_.find(planned->command.id);
    if (answer && !model::is_final(answer->status.state) && answer->status.state != model::CommandState::started) {
      (void)client_.cancel(planned->command.robot, planned->command.id);
    }
  }
  (void)client_.spin_until(LocalTime::clock::now() + local(options_.wind_down),
                           [this] { return client_.open() == 0 || !client_.planner_alive(); });
}

RunEnd ProgramRun::run(const std::function<bool()>& interrupted) {
  start_ = LocalTime::clock::now();
  changed_ = start_;
  planner_seen_ = start_;
  for (;;) {
    const LocalTime now = LocalTime::clock::now();
    release(now);
    if (all_done()) return client_.planner_replaced() ? RunEnd::planner_lost : RunEnd::finished;
    const bool lost = planner_lost(now);
    if (lost || interrupted() || stalled(now)) {
      give_up();
      return lost ? RunEnd::planner_lost : interrupted() ? RunEnd::interrupted : RunEnd::stalled;
    }
    const std::size_t open_before = client_.open();
    (void)client_.spin_until(std::min(next_release(), now + kLook),
                             [&] { return interrupted() || client_.open() != open_before || client_.planner_replaced(); });
  }
}

app::RunReport ProgramRun::report() const {
  app::ReportCollector nothing_told{model::Instant{}};
  for (const auto& planned : plan_) nothing_told.on_submitted(planned.command.id, planned.command.robot, planned.release);
  app::RunReport report = (collector_ ? *collector_ : nothing_told).finish(client_.planner()->strategy);
  for (app::CommandRow& row : report.commands) {
    if (model::is_final(row.state) || !row.explanation.empty()) continue;
    const bool sent = client_.find(row.id) != nullptr;
    row.explanation = sent ? "no news of its end; what became of it is not known" : "not sent";
  }
  return report;
}

}  // namespace interlace::client

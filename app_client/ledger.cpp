#include "app_client/ledger.hpp"

#include <algorithm>
#include <vector>

namespace interlace::client {

using model::CommandState;
using model::Reason;

namespace {

bool same(const std::vector<model::EscapeRefusal>& a, const std::vector<model::EscapeRefusal>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.robot == y.robot && x.way == y.way && x.text == y.text; });
}

/// Saying it again would tell nobody anything new.
bool same_news(const model::CommandStatus& a, const model::CommandStatus& b) {
  return a.state == b.state && a.reason == b.reason && a.text == b.text && a.start == b.start && a.end == b.end && a.verdict == b.verdict &&
         same(a.refusals, b.refusals);
}

std::string seconds_text(LocalDuration d) {
  return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(d).count()) + " s";
}

constexpr const char* kPlannerReplaced = "the planner was restarted; whether this was carried out is not known";
constexpr const char* kNotSent = "not sent: a command before it was lost";

}  // namespace

Ledger::Entry& Ledger::enter(const Request& request, const model::CommandId& id, const model::RobotName& robot) {
  Entry entry;
  entry.request = request;
  entry.answer.status.id = id;
  entry.answer.status.robot = robot;
  return entries_.emplace(id, std::move(entry)).first->second;
}

bool Ledger::submit(const model::CommandSubmitted& command) {
  if (entries_.count(command.id) > 0) return false;
  enter(command, command.id, command.robot);
  lines_[command.robot].unsent.push_back(command.id);
  return true;
}

void Ledger::cancel(const model::RobotName& robot, const model::CommandId& id) {
  const model::CommandCancelled request{id, robot};
  const auto found = entries_.find(id);
  if (found == entries_.end()) {
    enter(request, id, robot);
  } else {
    if (model::is_final(found->second.answer.status.state)) return;
    if (std::holds_alternative<model::CommandSubmitted>(found->second.request) && !found->second.sent) {
      for (auto& [other, order] : orders_) {  // it may be part of a replacement that is not sent yet
        auto* replacement = std::get_if<model::QueueReplaced>(&order.request);
        if (!replacement) continue;
        auto& commands = replacement->commands;
        commands.erase(std::remove_if(commands.begin(), commands.end(), [&](const auto& c) { return c.id == id; }), commands.end());
      }
      close(id, CommandState::cancelled, Reason::on_request, "given up before it was sent");
      return;
    }
  }
  orders_.emplace(id, Order{request, ++last_turn_, std::nullopt});
}

bool Ledger::stop(const model::StopRequested& request) {
  if (entries_.count(request.id) > 0) return false;
  close_unsent(request.robot, Reason::on_request, "given up before it was sent");
  return give(request, request.id, request.robot);
}

bool Ledger::hold(const model::HoldRequested& request) {
  return give(request, request.id, request.robot);
}

bool Ledger::resume(const model::ResumeRequested& request) {
  return give(request, request.id, request.robot);
}

bool Ledger::replace(const model::QueueReplaced& request) {
  std::set<model::CommandId> ids{request.id};
  for (const auto& command : request.commands) {
    if (!ids.insert(command.id).second) return false;
  }
  if (std::any_of(ids.begin(), ids.end(), [&](const auto& id) { return entries_.count(id) > 0; })) return false;
  close_unsent(request.robot, Reason::replaced, "replaced before it was sent by " + request.id.str());
  Line& line = lines_[request.robot];
  for (const auto& command : request.commands) {
    enter(command, command.id, request.robot);
    line.told.push_back(command.id);
  }
  return give(request, request.id, request.robot);
}

/// Takes a request over that is neither a command nor the end of one. False when the id is already known.
bool Ledger::give(const Request& request, const model::CommandId& id, const model::RobotName& robot) {
  if (entries_.count(id) > 0) return false;
  enter(request, id, robot);
  orders_.emplace(id, Order{request, ++last_turn_, std::nullopt});
  return true;
}

/// What of the robot was not sent yet is not sent any more, a replacement included.
void Ledger::close_unsent(const model::RobotName& robot, Reason reason, const std::string& text) {
  const auto line = lines_.find(robot);
  if (line == lines_.end()) return;
  if (const Order* replacement = replacement_of(robot); replacement && !replacement->sent) {
    const auto request = std::get<model::QueueReplaced>(replacement->request);
    for (const auto& command : request.commands) close(command.id, CommandState::cancelled, reason, text);
    close(request.id, CommandState::cancelled, reason, text);
  }
  while (!line->second.unsent.empty()) close(model::CommandId{line->second.unsent.back()}, CommandState::cancelled, reason, text);
}

/// The replacement of a robot's queue that is not answered, if there is one.
const Ledger::Order* Ledger::replacement_of(const model::RobotName& robot) const {
  for (const auto& [id, order] : orders_) {
    const auto* request = std::get_if<model::QueueReplaced>(&order.request);
    if (request && request->robot == robot) return &order;
  }
  return nullptr;
}

/// A replacement goes after the command on its way: that one is to be replaced, too.
bool Ledger::held_back(const Order& order) const {
  const auto* request = std::get_if<model::QueueReplaced>(&order.request);
  if (!request || order.sent) return false;
  const auto line = lines_.find(request->robot);
  return line != lines_.end() && line->second.asked.has_value();
}

/// The commands of a replacement are on their way with it.
void Ledger::mark_sent(const Request& request, LocalTime now) {
  const auto* replacement = std::get_if<model::QueueReplaced>(&request);
  if (!replacement) return;
  for (const auto& command : replacement->commands) entries_.at(command.id).sent = Sending{now, now};
}

/// The answer to a replacement is one to each of its commands, whose own may be lost.
void Ledger::settle_replacement(const model::QueueReplaced& request, const model::CommandStatus& status, LocalTime now) {
  for (const auto& command : request.commands) {
    if (status.state == CommandState::completed) {
      entries_.at(command.id).heard = now;
    } else {
      close(command.id, CommandState::rejected, status.reason, "its replacement was refused: " + status.text);
    }
  }
}

void Ledger::refuse(const model::CommandId& id, const std::string& text) {
  close(id, CommandState::rejected, Reason::bad_request, text);
}

/// The client's own last word on a command.
void Ledger::close(const model::CommandId& id, CommandState state, Reason reason, std::string text) {
  orders_.erase(id);
  const auto found = entries_.find(id);
  if (found == entries_.end() || model::is_final(found->second.answer.status.state)) return;
  Answer& answer = found->second.answer;
  remove_from_line(answer.status.robot, id);
  // A replacement that nobody answered takes its commands along.
  if (const auto* replacement = std::get_if<model::QueueReplaced>(&found->second.request)) {
    for (const auto& command : std::vector(replacement->commands)) close(command.id, state, reason, text);
  }
  answer.told = false;
  answer.status.state = state;
  answer.status.reason = reason;
  answer.status.text = std::move(text);
  answer.status.conflicts.clear();
  answer.status.refusals.clear();
  news_.push_back(answer);
}

void Ledger::remove_from_line(const model::RobotName& robot, const model::CommandId& id) {
  const auto found = lines_.find(robot);
  if (found == lines_.end()) return;
  Line& line = found->second;
  if (line.asked == id) line.asked.reset();
  for (auto* queue : {&line.told, &line.unsent}) {
    const auto at = std::find(queue->begin(), queue->end(), id);
    if (at != queue->end()) queue->erase(at);
  }
}

void Ledger::lose_everything() {
  std::vector<model::CommandId> lost;
  for (const auto& [robot, line] : lines_) {
    lost.insert(lost.end(), line.told.begin(), line.told.end());
    if (line.asked) lost.push_back(*line.asked);
    lost.insert(lost.end(), line.unsent.begin(), line.unsent.end());
  }
  for (const auto& [id, order] : orders_) lost.push_back(id);
  for (const auto& id : lost) {
    const auto found = entries_.find(id);
    const bool sent = found != entries_.end() && (found->second.sent || orders_.count(id) > 0);
    close(id, CommandState::failed, Reason::unknown_id, sent ? kPlannerReplaced : kNotSent);
  }
}

bool Ledger::on_planner(std::uint64_t incarnation, LocalTime now) {
  if (replaced_.count(incarnation) > 0) return false;
  if (planner_ != 0 && planner_ != incarnation) {
    replaced_.insert(planner_);
    lose_everything();
  }
  planner_ = incarnation;
  planner_heard_ = now;
  return true;
}

void Ledger::on_status(std::uint64_t incarnation, const model::CommandStatus& status, LocalTime now) {
  if (!on_planner(incarnation, now)) return;
  const auto found = entries_.find(status.id);
  if (found == entries_.end()) {
    news_.push_back({status, false, true});
    return;
  }
  Entry& entry = found->second;
  entry.heard = now;
  const bool was_final = model::is_final(entry.answer.status.state);
  // A cancellation is answered by the end of its command, or by its start: then it came too late. A stop is answered at once.
  // An escape is the planner's own and not given up for a client: any news of it is the answer.
  if (model::is_final(status.state) || status.state == CommandState::started || status.escape) orders_.erase(status.id);
  if (was_final) return;
  if (const auto* replacement = std::get_if<model::QueueReplaced>(&entry.request); replacement && model::is_final(status.state)) {
    settle_replacement(*replacement, status, now);
  }
  if (Line& line = lines_[status.robot]; line.asked == status.id) {
    line.asked.reset();
    line.told.push_back(status.id);
  }
  if (entry.answer.told && same_news(entry.answer.status, status)) return;
  entry.answer.status = status;
  entry.answer.told = true;
  if (model::is_final(status.state)) remove_from_line(status.robot, status.id);
  news_.push_back(entry.answer);
}

bool Ledger::resend(Sending& sent, LocalTime now, bool lives) const {
  if (!lives || now - sent.last < patience_.resend) return false;
  sent.last = now;
  return true;
}

void Ledger::give_up_orders(LocalTime now) {
  std::vector<model::CommandId> lost;
  for (const auto& [id, order] : orders_) {
    if (order.sent && now - order.sent->first >= patience_.give_up) lost.push_back(id);
  }
  for (const auto& id : lost) {
    const auto entry = entries_.find(id);
    orders_.erase(id);
    // A command of this client outlives the failed attempt to cancel it.
    if (entry == entries_.end() || std::holds_alternative<model::CommandSubmitted>(entry->second.request)) continue;
    close(id, CommandState::failed, Reason::unknown_id, "the planner did not answer within " + seconds_text(patience_.give_up));
  }
}

void Ledger::give_up_unanswered(Line& line, LocalTime now) {
  if (!line.asked) return;
  const auto& sent = entries_.at(*line.asked).sent;
  if (!sent || now - sent->first < patience_.give_up) return;
  close(model::CommandId{*line.asked}, CommandState::failed, Reason::unknown_id,
        "the planner did not answer within " + seconds_text(patience_.give_up) + "; whether it is carried out is not known");
  while (!line.unsent.empty()) close(model::CommandId{line.unsent.front()}, CommandState::failed, Reason::unknown_id, kNotSent);
}

std::vector<Request> Ledger::due(LocalTime now) {
  looked_ = now;
  std::vector<Request> out;
  give_up_orders(now);
  for (auto& [robot, line] : lines_) give_up_unanswered(line, now);
  const bool lives = planner_lives(now);
  if (!lives) return out;
  std::vector<Order*> orders;
  for (auto& [id, order] : orders_) orders.push_back(&order);
  std::sort(orders.begin(), orders.end(), [](const Order* a, const Order* b) { return a->turn < b->turn; });
  for (Order* order : orders) {
    if (held_back(*order)) continue;
    if (!order->sent) {
      order->sent = Sending{now, now};
      mark_sent(order->request, now);
      out.push_back(order->request);
    } else if (resend(*order->sent, now, lives)) {
      out.push_back(order->request);
    }
  }
  for (auto& [robot, line] : lines_) {
    const bool replacing = replacement_of(robot) != nullptr;
    if (line.asked) {
      Entry& entry = entries_.at(*line.asked);
      if (resend(*entry.sent, now, lives)) out.push_back(entry.request);
    } else if (!line.unsent.empty() && !replacing) {
      line.asked = line.unsent.front();
      line.unsent.pop_front();
      Entry& entry = entries_.at(*line.asked);
      entry.sent = Sending{now, now};
      out.push_back(entry.request);
    }
    // The first in the line is the one that moves; those behind it have every reason to be silent.
    if (!line.told.empty() && !replacing) {
      Entry& entry = entries_.at(line.told.front());
      if (now - std::max(entry.heard, entry.sent->last) >= patience_.silence) {
        entry.sent->last = now;
        out.push_back(entry.request);
      }
    }
  }
  return out;
}

std::optional<LocalTime> Ledger::next_due() const {
  std::optional<LocalTime> next;
  const auto consider = [&](LocalTime t) { next = next ? std::min(*next, t) : t; };
  const bool lives = planner_lives(looked_);
  const auto consider_sending = [&](const Sending& sent) {
    consider(sent.first + patience_.give_up);
    if (lives) consider(sent.last + patience_.resend);
  };
  for (const auto& [id, order] : orders_) {
    if (order.sent) {
      consider_sending(*order.sent);
    } else if (lives && !held_back(order)) {
      consider(looked_);
    }
  }
  for (const auto& [robot, line] : lines_) {
    const bool replacing = replacement_of(robot) != nullptr;
    if (line.asked) {
      consider_sending(*entries_.at(*line.asked).sent);
    } else if (lives && !line.unsent.empty() && !replacing) {
      consider(looked_);
    }
    if (lives && !line.told.empty() && !replacing) {
      const Entry& entry = entries_.at(line.told.front());
      consider(std::max(entry.heard, entry.sent->last) + patience_.silence);
    }
  }
  return next;
}

std::vector<Answer> Ledger::take_news() {
  std::vector<Answer> news;
  news.swap(news_);
  return news;
}

const Answer* Ledger::find(const model::CommandId& id) const {
  const auto found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second.answer;
}

std::size_t Ledger::open(const model::RobotName& robot) const {
  const auto found = lines_.find(robot);
  return found == lines_.end() ? 0 : found->second.size();
}

std::size_t Ledger::open() const {
  std::size_t n = 0;
  for (const auto& [robot, line] : lines_) n += line.size();
  return n;
}

}  // namespace interlace::client

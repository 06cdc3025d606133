#include "tests/model/world.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace interlace::test {

using model::CommandState;
using model::Instant;
using model::RobotIndex;
using Kind = Choice::Kind;

World::World(const Scenario& scenario, MotionsSeen& motions, Judge& judge)
    : scenario_(&scenario), motions_(&motions), judge_(&judge), planner_(scenario.cell, scenario.options) {
  for (RobotIndex i = 0; i < scenario.cell->robots.size(); ++i) robots_.push_back({IdealProxy{scenario.cell->robots[i]}, i, {}, {}, {}});
  for (RobotIndex i = 0; i < robots_.size(); ++i) say_where(i);
}

std::vector<Choice> World::choices() const {
  std::vector<Choice> result;
  const Liberties& free = scenario_->liberties;
  const bool idle = all_final() && all_rest() && !silent();
  if (idle && all_submitted()) return result;
  const auto deadline = planner_.next_deadline();
  const bool due = deadline && *deadline <= now_;
  if (due) result.push_back({Kind::advance, 0});
  bool nobody_urgent = !due && !(silent() && now_ >= silent_until_);
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    const Robot& r = robots_[i];
    nobody_urgent = nobody_urgent && !urgent(i);
    if (!r.reports.empty() && heard(i)) result.push_back({Kind::deliver, i});
    const auto& waiting = r.proxy.waiting();
    if (waiting && now_ >= waiting->earliest) result.push_back({Kind::start, i});
    if (waiting && free.refusal && !refused_) result.push_back({Kind::refuse, i});
    if (next_order(i) != nullptr) result.push_back({Kind::submit, i});
  }
  if (!free.cancelled.empty() && !cancelled_) {
    const auto known = said_.find(free.cancelled);
    if (known != said_.end() && !is_final(known->second.newest.state)) result.push_back({Kind::cancel, order(free.cancelled)->robot});
  }
  if (free.silent && silence_ == Silence::not_yet) result.push_back({Kind::silence, *free.silent});
  if (silent()) result.push_back({Kind::back, *free.silent});
  if (nobody_urgent && !idle && next_instant()) result.push_back({Kind::wait, 0});
  return result;
}

void World::happen(const Choice& choice) {
  Robot& r = robots_[choice.robot];
  switch (choice.kind) {
    case Kind::submit: {
      const Order* o = next_order(choice.robot);
      ++r.submitted;
      if (!has_work(r)) r.ready = now_;
      model::CommandSubmitted c;
      c.id = model::CommandId{o->id};
      c.robot = r.proxy.robot().name;
      c.motion = o->motion;
      take(planner_.on(c, now_));
      break;
    }
    case Kind::cancel:
      cancelled_ = true;
      take(planner_.on(model::CommandCancelled{model::CommandId{scenario_->liberties.cancelled}, r.proxy.robot().name}, now_));
      break;
    case Kind::deliver: {
      const model::ExecutionReported e = r.reports.front().report;
      r.reports.pop_front();
      if (e.state != model::ExecutionState::accepted && e.state != model::ExecutionState::started) r.ready = now_;
      take(planner_.on(e, now_));
      break;
    }
    case Kind::start:
      r.motion = *std::exchange(r.sent, std::nullopt);
      r.way.push_back(r.motion);
      report(choice.robot, r.proxy.start(now_, 1, (*motions_)[r.motion]));
      break;
    case Kind::refuse:
      refused_ = true;
      r.sent.reset();
      report(choice.robot, r.proxy.refuse(now_, "not now"));
      break;
    case Kind::silence:
      silence_ = Silence::now;
      silent_until_ = now_ + kLongestSilence;
      break;
    case Kind::back:
      silence_ = Silence::over;
      say_where(choice.robot);
      break;
    case Kind::advance: take(planner_.advance(now_)); break;
    case Kind::wait: pass_until(*next_instant()); break;
  }
  judge_rest();
}

/// True when something of this robot must happen before time passes.
bool World::urgent(RobotIndex i) const {
  const Robot& r = robots_[i];
  if (!r.reports.empty() && heard(i) && (r.reports.front().due <= now_ || !scenario_->liberties.late_reports)) return true;
  if (!r.proxy.waiting()) return false;
  return now_ >= (scenario_->liberties.late_starts ? r.proxy.waiting()->latest : r.proxy.waiting()->earliest);
}

/// When something begins, ends or falls due next.
std::optional<Instant> World::next_instant() const {
  std::optional<Instant> next;
  const auto consider = [&](Instant t) {
    if (t > now_) next = next ? std::min(*next, t) : t;
  };
  if (const auto deadline = planner_.next_deadline()) consider(*deadline);
  if (silent()) consider(silent_until_);
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    const Robot& r = robots_[i];
    if (!r.reports.empty() && heard(i)) consider(r.reports.front().due);
    if (r.proxy.moving(now_)) {
      const Executed& moves = r.proxy.executed().back();
      consider(moves.start + (moves.end() - moves.start) / 2);  // time for what may happen at any time
      consider(moves.end());
    }
    if (r.proxy.waiting()) consider(r.proxy.waiting()->earliest);
    if (r.proxy.waiting()) consider(r.proxy.waiting()->latest);
    if (scenario_->options.posture_timeout && heard(i)) consider(r.heard + *scenario_->options.posture_timeout / 2);
  }
  return next;
}

void World::pass_until(Instant t) {
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    for (RobotIndex j = i + 1; j < robots_.size(); ++j) {
      const Robot& a = robots_[i];
      const Robot& b = robots_[j];
      if (!a.proxy.moving(now_) && !b.proxy.moving(now_)) continue;  // seen when the later of them arrived
      const double clearance = judge_->least(under_way(a), under_way(b), t - now_);
      least_ = std::min(least_, clearance);
      if (clearance <= 0) blame(fmt::format("{} and {} touch", a.proxy.robot().name.str(), b.proxy.robot().name.str()));
    }
  }
  std::vector<bool> moved;
  for (const Robot& r : robots_) moved.push_back(r.proxy.moving(now_));
  now_ = t;
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    IdealProxy& proxy = robots_[i].proxy;
    if (moved[i] && !proxy.moving(now_)) report(i, proxy.arrive(now_));
    if (scenario_->options.posture_timeout && heard(i)) say_where(i);
  }
}

void World::say_where(RobotIndex i) {
  Robot& r = robots_[i];
  model::PostureReported p;
  p.robot = r.proxy.robot().name;
  p.at = now_;
  p.joints = r.proxy.joints(now_);
  p.moving = r.proxy.moving(now_);
  if (p.moving) p.motion = model::CommandId{r.proxy.executed().back().id};
  r.heard = now_;
  take(planner_.on(p, now_));
}

void World::report(RobotIndex i, const std::optional<model::ExecutionReported>& e) {
  if (e) robots_[i].reports.push_back({*e, now_ + scenario_->options.confirm});
}

void World::take(const core::Decisions& decisions) {
  for (const auto& s : decisions.statuses) {
    const auto [entry, fresh] = said_.try_emplace(s.id.str());
    Said& said = entry->second;
    if (fresh && s.escape) escapes_.push_back(s.id.str());
    if (is_final(said.newest.state) && !fresh && said.newest.state != s.state) blame(s.id.str() + " has an end and goes on");
    if (is_final(s.state)) ++said.finals;
    said.newest = s;
    said.delayed = said.delayed || (s.state == CommandState::scheduled && s.reason == model::Reason::delayed);
    said.blocked = said.blocked || s.reason == model::Reason::blocked;
    if (s.reason == model::Reason::deadlock && !silent()) {  // who is not heard from cannot be sent away: then people are asked rightly
      std::string tried;
      for (const auto& e : s.refusals) tried += fmt::format("; {} {}: {}", e.robot.str(), to_string(e.way), e.text);
      blame(fmt::format("a person is asked for help: {}{}", s.text, tried));
    }
    if (s.state == CommandState::rejected || s.state == CommandState::failed) blame(fmt::format("{} is lost: {}", s.id.str(), s.text));
    if (s.state == CommandState::cancelled && !s.escape && s.id.str() != scenario_->liberties.cancelled) {
      blame(s.id.str() + " is cancelled by nobody");
    }
  }
  for (const auto& d : decisions.dispatches) {
    const RobotIndex i = scenario_->cell->find(d.robot).value();
    Robot& r = robots_[i];
    const auto answer = r.proxy.on(d, now_);
    if (r.proxy.waiting() && r.proxy.waiting()->id == d.id) r.sent = motions_->number(i, d.from, d.motion);
    if (answer && answer->state == model::ExecutionState::refused && !scenario_->liberties.silent) {
      blame(fmt::format("{} is sent what it must refuse: {}", d.robot.str(), answer->text));
    }
    report(i, answer);
  }
  for (const auto& w : decisions.withdrawals) {
    const RobotIndex i = scenario_->cell->find(w.robot).value();
    report(i, robots_[i].proxy.on(w, now_));
    if (!robots_[i].proxy.waiting()) robots_[i].sent.reset();
  }
}

/// Nothing may stay undone when nothing will happen by itself any more.
void World::judge_rest() {
  if (!fault_.empty() || silent() || !all_rest()) return;
  if (planner_.next_deadline() && !all_final()) return;
  for (const auto& [id, said] : said_) {
    const model::CommandStatus& s = said.newest;
    if (!is_final(s.state)) return blame(fmt::format("nothing moves and {} is {}: {}", id, to_string(s.state), s.text));
    if (said.finals != 1) return blame(fmt::format("{} has {} ends", id, said.finals));
    if (!s.escape) continue;
    const auto served = said_.find(s.serves.str());
    if (served == said_.end() || order(s.serves.str()) == nullptr) return blame(id + " serves no command");
  }
}

bool World::all_rest() const {
  return std::all_of(robots_.begin(), robots_.end(),
                     [&](const Robot& r) { return r.reports.empty() && !r.proxy.waiting() && !r.proxy.moving(now_); });
}

bool World::has_work(const Robot& r) const {
  return std::any_of(said_.begin(), said_.end(),
                     [&](const auto& s) { return s.second.newest.robot == r.proxy.robot().name && !is_final(s.second.newest.state); });
}

bool World::all_final() const {
  return std::all_of(said_.begin(), said_.end(), [](const auto& s) { return is_final(s.second.newest.state); });
}

bool World::all_submitted() const {
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (next_order(i) != nullptr) return false;
  }
  return true;
}

const Order* World::next_order(RobotIndex i) const {
  std::size_t before = robots_[i].submitted;
  for (const Order& o : scenario_->orders) {
    if (o.robot == i && before-- == 0) return &o;
  }
  return nullptr;
}

const Order* World::order(const std::string& id) const {
  const auto& all = scenario_->orders;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Order& o) { return o.id == id; });
  return found != all.end() ? &*found : nullptr;
}

UnderWay World::under_way(const Robot& r) const {
  const model::Duration whole = model::from_seconds((*motions_)[r.motion]->duration());
  return {r.motion, r.proxy.moving(now_) ? now_ - r.proxy.executed().back().start : whole};
}

void World::blame(std::string text) {
  if (fault_.empty()) fault_ = std::move(text);
}

std::string World::signature() const {
  std::string s;
  const auto put = [&s](auto value) {
    s += std::to_string(value);
    s += ' ';
  };
  const auto put_time = [&](const std::optional<Instant>& t) { t ? put((*t - now_).count()) : put('-'); };
  // Escapes get new names whenever they are planned anew: their place among those that are not over tells them apart.
  std::map<std::string, std::size_t> open;
  for (const std::string& id : escapes_) {
    if (!is_final(said_.at(id).newest.state)) open.emplace(id, open.size());
  }
  const auto put_id = [&](const std::string& id) {
    const auto e = open.find(id);
    s += e != open.end() ? "e" + std::to_string(e->second) : order(id) != nullptr ? id : "e";
    s += ' ';
  };
  for (const Robot& r : robots_) {
    for (const std::size_t m : r.way) put(m);
    s += '@';
    put((under_way(r).since).count());
    put(r.submitted);
    if (const auto& w = r.proxy.waiting()) {
      put_id(w->id.str());
      put(*r.sent);
      put(w->attempt);
      put_time(w->earliest);
      put_time(w->latest);
    }
    for (const Report& m : r.reports) {
      s += '>';
      put_id(m.report.id.str());
      put(m.report.attempt);
      put(static_cast<int>(m.report.state));
      put_time(m.report.at);
      put_time(m.due);
    }
    for (const Robot& other : robots_) s += r.ready < other.ready ? '<' : r.ready > other.ready ? '>' : '=';
    if (scenario_->options.posture_timeout) put(std::min(now_ - r.heard, *scenario_->options.posture_timeout * 2).count());
    s += '\n';
  }
  for (const auto& [id, said] : said_) {
    const model::CommandStatus& c = said.newest;
    if (c.escape && is_final(c.state)) continue;
    put_id(id);
    put(static_cast<int>(c.state));
    if (is_final(c.state)) continue;
    put(static_cast<int>(c.reason));
    put_time(c.start);
    put_time(c.end);
    put_id(c.serves.str());
  }
  put(static_cast<int>(cancelled_));
  put(static_cast<int>(refused_));
  put(static_cast<int>(silence_));
  if (silent()) put_time(silent_until_);
  put_time(planner_.next_deadline());
  return s;
}

std::string World::tell(const Choice& choice) const {
  const Robot& r = robots_[choice.robot];
  const std::string name = r.proxy.robot().name.str();
  const auto what = [&]() -> std::string {
    switch (choice.kind) {
      case Kind::submit: return "submit " + next_order(choice.robot)->id;
      case Kind::cancel: return "cancel " + scenario_->liberties.cancelled;
      case Kind::deliver: {
        const auto& e = r.reports.front().report;
        return fmt::format("{} is heard: {} {} at {:.4f}", name, e.id.str(), to_string(e.state), model::to_seconds(e.at));
      }
      case Kind::start: return fmt::format("{} starts {}", name, r.proxy.waiting()->id.str());
      case Kind::refuse: return fmt::format("{} refuses {}", name, r.proxy.waiting()->id.str());
      case Kind::silence: return name + " falls silent";
      case Kind::back: return name + " is heard again";
      case Kind::advance: return "planner's deadline";
      case Kind::wait: return fmt::format("until {:.4f}", model::to_seconds(*next_instant()));
    }
    return {};
  };
  return fmt::format("{:.4f} {}", model::to_seconds(now_), what());
}

}  // namespace interlace::test

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/model/motion.hpp"

namespace interlace::test {

/// A motion as it was really carried out.
struct Executed {
  std::string id;
  std::shared_ptr<const model::Motion> motion;
  model::Instant start{};
  double stretch = 1;                   ///< of its duration: the controller's speed error
  model::Instant earliest{}, latest{};  ///< of the dispatch that started it

  [[nodiscard]] model::Instant end() const { return start + model::from_seconds(motion->duration() * stretch); }
};

/// A proxy and its controller with no faults but those of the network: carries a dispatch out once, inside its window or not at all, and
/// answers every repetition with what became of it.
class IdealProxy {
 public:
  explicit IdealProxy(const model::Robot& robot) : robot_(&robot), joints_(robot.start) {}

  [[nodiscard]] const model::Robot& robot() const { return *robot_; }
  [[nodiscard]] const std::vector<Executed>& executed() const { return executed_; }
  [[nodiscard]] bool moving(model::Instant now) const {
    return !executed_.empty() && executed_.back().start <= now && now < executed_.back().end();
  }
  [[nodiscard]] model::Joints joints(model::Instant now) const {
    if (!moving(now)) return joints_;
    return executed_.back().motion->joints(model::to_seconds(now - executed_.back().start) / executed_.back().stretch);
  }

  /// Its answer, if it has one yet.
  [[nodiscard]] std::optional<model::ExecutionReported> on(const model::Dispatch& d, model::Instant now) {
    if (const auto known = last_.find(d.id.str()); known != last_.end()) {
      if (d.attempt < known->second.attempt) return std::nullopt;
      if (started_.count(d.id.str()) > 0 || d.attempt == known->second.attempt) return known->second;
    }
    if (waiting_ && waiting_->id == d.id) waiting_.reset();
    if (waiting_ || moving(now)) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "busy");
    if ((joints_ - d.from).cwiseAbs().maxCoeff() > 1e-9) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "elsewhere");
    if (now > d.latest) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "too late");
    waiting_ = d;
    return answer(d.id, d.attempt, model::ExecutionState::accepted, now);
  }
  [[nodiscard]] std::optional<model::ExecutionReported> on(const model::Withdrawal& w, model::Instant now) {
    if (const auto known = last_.find(w.id.str()); known != last_.end()) {
      if (w.attempt < known->second.attempt) return std::nullopt;
      if (started_.count(w.id.str()) > 0) return known->second;
    }
    if (waiting_ && waiting_->id == w.id) waiting_.reset();
    return answer(w.id, w.attempt, model::ExecutionState::withdrawn, now);
  }

  /// The dispatch that waits for its window.
  [[nodiscard]] const std::optional<model::Dispatch>& waiting() const { return waiting_; }

  /// Gives the waiting dispatch up, as a controller does that cannot start it.
  [[nodiscard]] model::ExecutionReported refuse(model::Instant now, const std::string& text) {
    const model::Dispatch d = *waiting_;
    waiting_.reset();
    return *answer(d.id, d.attempt, model::ExecutionState::refused, now, text);
  }
  /// Begins the waiting motion; `motion` is what its dispatch means, where the caller has planned that already.
  [[nodiscard]] model::ExecutionReported start(model::Instant now, double stretch, std::shared_ptr<const model::Motion> motion = {}) {
    const model::Dispatch d = *waiting_;
    waiting_.reset();
    started_.insert(d.id.str());
    if (!motion) motion = std::make_shared<const model::Motion>(model::plan_motion(*robot_, joints_, d.motion).value());
    executed_.push_back({d.id.str(), std::move(motion), now, stretch, d.earliest, d.latest});
    return *answer(d.id, d.attempt, model::ExecutionState::started, now);
  }
  [[nodiscard]] model::ExecutionReported arrive(model::Instant now) {
    joints_ = executed_.back().motion->to();
    const model::CommandId id{executed_.back().id};
    return *answer(id, last_.at(id.str()).attempt, model::ExecutionState::completed, now);
  }

 private:
  std::optional<model::ExecutionReported> answer(const model::CommandId& id, std::uint32_t attempt, model::ExecutionState state,
                                                 model::Instant now, const std::string& text = {}) {
    model::ExecutionReported e;
    e.id = id;
    e.robot = robot_->name;
    e.attempt = attempt;
    e.state = state;
    e.at = now;
    e.joints = joints_;
    e.text = text;
    last_[id.str()] = e;
    return e;
  }

  const model::Robot* robot_;
  model::Joints joints_;  // where it stands, or stood before the running motion
  std::optional<model::Dispatch> waiting_;
  std::vector<Executed> executed_;
  std::map<std::string, model::ExecutionReported> last_;
  std::set<std::string> started_;
};

}  // namespace interlace::test

#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/model/motion.hpp"

namespace interlace::test {

/// The motions of one walk, each planned once and known by a number: what equal states are recognised by. Standing where it starts is the
/// motion that has its robot's own number.
class MotionsSeen {
 public:
  explicit MotionsSeen(const model::Cell& cell) : cell_(cell) {
    for (const model::Robot& r : cell.robots) all_.push_back(std::make_shared<const model::Motion>(model::Motion::rest(r, r.start)));
  }

  /// Number of what `request` means for `robot` standing at `from`; throws std::logic_error when it can be no motion.
  std::size_t number(model::RobotIndex robot, const model::Joints& from, const model::MotionRequest& request) {
    std::string key(reinterpret_cast<const char*>(from.data()), sizeof(double) * model::kJoints);
    key += std::to_string(robot);
    if (const auto* line = std::get_if<model::LinearTarget>(&request.target)) {
      key.append(reinterpret_cast<const char*>(line->X_WT.data()), sizeof(double) * 16);
    } else {
      key.append(reinterpret_cast<const char*>(std::get<model::JointTarget>(request.target).q.data()), sizeof(double) * model::kJoints);
    }
    const auto [entry, fresh] = numbers_.try_emplace(key, all_.size());
    if (fresh) all_.push_back(std::make_shared<const model::Motion>(model::plan_motion(cell_.robots[robot], from, request).value()));
    return entry->second;
  }
  [[nodiscard]] const std::shared_ptr<const model::Motion>& operator[](std::size_t number) const { return all_[number]; }
  [[nodiscard]] std::size_t size() const { return all_.size(); }

 private:
  const model::Cell& cell_;
  std::vector<std::shared_ptr<const model::Motion>> all_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace interlace::test

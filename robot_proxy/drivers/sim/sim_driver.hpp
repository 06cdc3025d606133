#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "robot_proxy/drivers/sim/sim_controller.hpp"

namespace interlace::proxy {

/// A simulated controller on the real monotonic clock, with a thread of its own as a foreign machine has. See Driver for the contract.
class SimDriver final : public Driver {
 public:
  static constexpr model::Duration kPeriod{4'000'000};  ///< interpolation of the controller

  /// `robot` is copied: the machine knows itself. The default interpolates every 4 ms.
  explicit SimDriver(const model::Robot& robot, SimOptions options = SimOptions{kPeriod});
  ~SimDriver() override;

  [[nodiscard]] DriverResult connect(Changed changed, model::Duration timeout) override;
  void disconnect() override;
  [[nodiscard]] Capabilities capabilities() const override;
  [[nodiscard]] ControllerState observe() override;
  [[nodiscard]] DriverResult execute(const model::MotionRequest& request, MotionNumber number) override;
  [[nodiscard]] DriverResult stop() override;

  /// Lets a test injure the controller, from any thread: runs `act` with it and the present time, under the lock.
  void with_controller(const std::function<void(SimController&, LocalTime)>& act);

 private:
  void run();

  model::Robot robot_;
  mutable std::mutex mutex_;  // guards all below but thread_
  std::condition_variable wake_;
  SimController controller_;
  Changed changed_;
  bool stirred_ = false;  // a call may have changed what comes next
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace interlace::proxy

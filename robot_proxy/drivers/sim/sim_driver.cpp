#include "robot_proxy/drivers/sim/sim_driver.hpp"

#include <algorithm>
#include <utility>

namespace interlace::proxy {

namespace {
LocalTime clock_now() {
  return std::chrono::steady_clock::now();
}
}  // namespace

SimDriver::SimDriver(const model::Robot& robot, SimOptions options) : robot_(robot), controller_(robot_, options) {}

SimDriver::~SimDriver() {
  disconnect();
}

DriverResult SimDriver::connect(Changed changed, model::Duration /*timeout*/) {
  if (thread_.joinable()) return model::unexpected(std::string("connected already"));
  {
    const std::lock_guard lock(mutex_);
    changed_ = std::move(changed);
    stopping_ = false;
  }
  thread_ = std::thread([this] { run(); });
  return {};
}

void SimDriver::disconnect() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

Capabilities SimDriver::capabilities() const {
  const std::lock_guard lock(mutex_);
  return controller_.capabilities();
}

ControllerState SimDriver::observe() {
  const std::lock_guard lock(mutex_);
  return controller_.observe(clock_now());
}

DriverResult SimDriver::execute(const model::MotionRequest& request, MotionNumber number) {
  DriverResult result;
  with_controller([&](SimController& controller, LocalTime now) { result = controller.execute(request, number, now); });
  return result;
}

DriverResult SimDriver::stop() {
  DriverResult result;
  with_controller([&](SimController& controller, LocalTime now) { result = controller.stop(now); });
  return result;
}

void SimDriver::with_controller(const std::function<void(SimController&, LocalTime)>& act) {
  {
    const std::lock_guard lock(mutex_);
    act(controller_, clock_now());
    stirred_ = true;
  }
  wake_.notify_one();
}

void SimDriver::run() {
  constexpr std::chrono::seconds kIdle{1};  // every wait has a deadline
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const LocalTime now = clock_now();
    stirred_ = false;
    if (changed_) {
      const Changed changed = changed_;
      lock.unlock();  // the contract: no lock is held while the proxy is told
      changed();
      lock.lock();
    }
    // An event between `now` and here is not lost: next_event counts from `now`, so the wait ends at once.
    const LocalTime wake = std::min(controller_.next_event(now).value_or(LocalTime::max()), now + kIdle);
    wake_.wait_until(lock, wake, [this] { return stirred_ || stopping_; });
  }
}

}  // namespace interlace::proxy

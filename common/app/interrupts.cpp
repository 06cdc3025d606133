#include "common/app/interrupts.hpp"

#include <cstdlib>

#include "common/app/exit_code.hpp"

namespace interlace::app {

Interrupts::Interrupts() {
  signals_.on_signal([this](int, int count) {
    if (count > 1) std::_Exit(to_int(ExitCode::interrupted));
    requested_ = true;
    const std::lock_guard lock{mutex_};
    if (waker_) waker_();
  });
}

Interrupts::Scope::Scope(Interrupts& owner, std::function<void()> waker) : owner_(owner) {
  const std::lock_guard lock{owner_.mutex_};
  owner_.waker_ = std::move(waker);
  if (owner_.requested_) owner_.waker_();
}

Interrupts::Scope::~Scope() {
  const std::lock_guard lock{owner_.mutex_};
  owner_.waker_ = nullptr;
}

}  // namespace interlace::app

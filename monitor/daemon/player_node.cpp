#include "monitor/daemon/player_node.hpp"

#include <utility>

#include "common/app/logging.hpp"

namespace interlace::monitor {

using app::log;
using app::LogLevel;

namespace {

constexpr std::chrono::milliseconds kPlayerPeriod{250};  // sign of life while nothing plays
constexpr std::size_t kMessages = 500;                   // at a time: what viewers ask meanwhile waits no longer than that takes

}  // namespace

PlayerNode::PlayerNode(std::unique_ptr<Playback> playback, const ServerOptions& server, Bundle bundle)
    : playback_(std::move(playback)), server_(server, std::move(bundle), [this](ViewerId viewer, const ViewerRequest& request) {
        asked_.note(viewer, request);
        wake();
      }) {
  log(LogLevel::info, "ready", {{"cell", playback_->cell().cell.name}, {"seconds", playback_->length()}, {"url", server_.url()}});
}

void PlayerNode::wake() {
  const std::lock_guard lock{mutex_};
  woken_ = true;
  changed_.notify_one();
}

void PlayerNode::wait_until(Clock::time_point deadline) {
  std::unique_lock lock{mutex_};
  changed_.wait_until(lock, deadline, [this] { return woken_; });
  woken_ = false;
}

void PlayerNode::stop() {
  stopping_ = true;
  wake();
}

void PlayerNode::run() {
  while (!stopping_) {
    wait_until(playback_->seeking() ? Clock::now() : next_pose_);
    const auto now = Clock::now();
    obey(now);
    playback_->advance(now, kMessages);
    show(now);
    if (!playback_->seeking() && asked_.answer(playback_->view(), server_)) wake();
  }
  log(LogLevel::info, "stopped", {{"viewers", server_.viewers()}});
}

void PlayerNode::obey(Clock::time_point now) {
  const Asked::Orders orders = asked_.take_orders();
  if (!begun_ && server_.viewers() > 0) {
    begun_ = true;
    playback_->play(1, now);
  }
  if (orders.seek) playback_->seek(orders.seek->t, now);
  if (orders.pace) {
    const auto* play = std::get_if<PlayRequest>(&*orders.pace);
    if (play != nullptr) playback_->play(play->speed, now);
    if (play == nullptr) playback_->pause(now);
  }
  if (orders.seek || orders.pace) next_player_ = now;
}

void PlayerNode::show(Clock::time_point now) {
  auto events = playback_->view().take_events();
  if (playback_->seeking()) {
    events.clear();
  } else if (playback_->take_arrived()) {
    events.clear();
    server_.broadcast(playback_->view().snapshot());
    next_player_ = now;
  }
  for (Frame& event : events) server_.broadcast(std::move(event));
  if (now >= next_pose_) {
    if (playback_->playing() && !playback_->seeking()) server_.broadcast(playback_->view().pose());
    next_pose_ = std::max(next_pose_ + LiveView::kPosePeriod, now);
  }
  if (now < next_player_) return;
  server_.broadcast(playback_->player());
  next_player_ = now + kPlayerPeriod;
}

}  // namespace interlace::monitor

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "monitor/daemon/asked.hpp"
#include "monitor/playback.hpp"
#include "monitor/server/web_server.hpp"

namespace interlace::monitor {

/// Shows a recording as MonitorNode shows a running cell, on the same page. It plays as soon as somebody looks on. One thread builds it,
/// runs it and destroys it; only stop() may be called from another.
class PlayerNode {
 public:
  /// Throws std::runtime_error when the address cannot be had.
  PlayerNode(std::unique_ptr<Playback> playback, const ServerOptions& server, Bundle bundle);

  /// Works until stop().
  void run();
  /// Ends run(). Any thread, not a signal handler.
  void stop();

  [[nodiscard]] std::string url() const { return server_.url(); }

 private:
  using Clock = std::chrono::steady_clock;

  void wait_until(Clock::time_point deadline);
  void wake();
  void obey(Clock::time_point now);
  void show(Clock::time_point now);

  std::unique_ptr<Playback> playback_;
  Asked asked_;
  std::mutex mutex_;  // of woken_
  std::condition_variable changed_;
  bool woken_ = false;
  std::atomic<bool> stopping_{false};
  bool begun_ = false;  // somebody has looked on
  Clock::time_point next_pose_{}, next_player_{};
  WebServer server_;  // last: its thread ends before what it calls goes
};

}  // namespace interlace::monitor

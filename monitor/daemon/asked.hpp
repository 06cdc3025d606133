#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <variant>

#include "monitor/live_view.hpp"
#include "monitor/server/web_server.hpp"

namespace interlace::monitor {

/// What viewers ask, between the server's thread and the one that has the view: bounded, because of each viewer the newest map counts, and
/// of all of them the newest order.
class Asked {
 public:
  /// What a player of recordings is told; empty: nothing.
  struct Orders {
    std::optional<std::variant<PlayRequest, PauseRequest>> pace;
    std::optional<SeekRequest> seek;
  };

  /// Any thread.
  void note(ViewerId viewer, const ViewerRequest& request);
  [[nodiscard]] Orders take_orders();

  /// Answers what can be answered from `view`. Maps take milliseconds: one at a time, so that nothing else waits for more than one. True:
  /// more is waiting.
  bool answer(LiveView& view, WebServer& server);

 private:
  std::mutex mutex_;
  std::set<ViewerId> snapshots_;
  std::map<ViewerId, model::CommandId> maps_;
  Orders orders_;
};

}  // namespace interlace::monitor

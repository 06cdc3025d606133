#include "monitor/daemon/asked.hpp"

#include <utility>

namespace interlace::monitor {

void Asked::note(ViewerId viewer, const ViewerRequest& request) {
  const std::lock_guard lock{mutex_};
  if (const auto* map = std::get_if<MapRequest>(&request)) {
    maps_[viewer] = map->command;
  } else if (std::holds_alternative<SnapshotRequest>(request)) {
    snapshots_.insert(viewer);
  } else if (const auto* seek = std::get_if<SeekRequest>(&request)) {
    orders_.seek = *seek;
  } else if (const auto* play = std::get_if<PlayRequest>(&request)) {
    orders_.pace = *play;
  } else {
    orders_.pace = PauseRequest{};
  }
}

Asked::Orders Asked::take_orders() {
  const std::lock_guard lock{mutex_};
  return std::exchange(orders_, {});
}

bool Asked::answer(LiveView& view, WebServer& server) {
  std::set<ViewerId> snapshots;
  std::map<ViewerId, model::CommandId> maps;
  bool more = false;
  {
    const std::lock_guard lock{mutex_};
    snapshots.swap(snapshots_);
    if (!maps_.empty()) maps.insert(maps_.extract(maps_.begin()));
    more = !maps_.empty();
  }
  if (!snapshots.empty()) {
    const Frame snapshot = view.snapshot();
    for (const ViewerId viewer : snapshots) server.send(viewer, snapshot);
  }
  for (const auto& [viewer, command] : maps) server.send(viewer, view.map(command));
  return more;
}

}  // namespace interlace::monitor

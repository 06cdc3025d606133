#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <map>
#include <memory>

#include "monitor/server/web_server.hpp"

/// What the connections of one server share. Internal to monitor/server; everything but `viewing` belongs to the server's thread.
namespace interlace::monitor {

class ViewerSession;

struct Hub {
  Hub(const ServerOptions& o, Bundle b, WebServer::OnRequest r) : options(o), bundle(std::move(b)), on_request(std::move(r)) {}

  ServerOptions options;
  Bundle bundle;
  WebServer::OnRequest on_request;
  bool loopback = true;
  std::size_t connections = 0;
  ViewerId last_viewer = 0;
  std::map<ViewerId, std::weak_ptr<ViewerSession>> viewers;
  std::atomic<std::size_t> viewing{0};
};

/// One of the connections a server may have, given back when this goes.
class Slot {
 public:
  explicit Slot(Hub& hub) : hub_(&hub) { ++hub.connections; }
  Slot(Slot&& other) noexcept : hub_(std::exchange(other.hub_, nullptr)) {}
  Slot& operator=(Slot&&) = delete;
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;
  ~Slot() {
    if (hub_ != nullptr) --hub_->connections;
  }

 private:
  Hub* hub_;
};

}  // namespace interlace::monitor

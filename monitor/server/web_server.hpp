#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "monitor/frame.hpp"
#include "monitor/server/bundle.hpp"
#include "monitor/server/frame_queue.hpp"
#include "monitor/server/viewer_request.hpp"

namespace interlace::monitor {

using ViewerId = std::uint64_t;  ///< never used twice

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< numeric, IPv4 or IPv6
  std::optional<std::uint16_t> port;  ///< empty: kDefaultPort, or another one that is free
  std::size_t connections = 128;      ///< at a time; more are closed at once
  std::size_t viewers = 16;           ///< of those; more are refused with 503
  QueueLimits queue;                  ///< of each viewer
};

inline constexpr std::uint16_t kDefaultPort = 8088;

/// Serves the page over HTTP and the frames over a WebSocket, all of it in one thread of its own, however many look on. Every limit a
/// stranger can reach is bounded: size and number of headers, no body, time for a request, connections, what waits for a viewer.
class WebServer {
 public:
  /// Called in the server's thread for everything viewers ask, a new one for its first snapshot too.
  using OnRequest = std::function<void(ViewerId, const ViewerRequest&)>;

  /// Listens from now on. Throws std::runtime_error when the address cannot be had, with the reason.
  WebServer(const ServerOptions& options, Bundle bundle, OnRequest on_request);
  /// Closes everything.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  // Any thread.
  void broadcast(Frame frame);
  /// Nothing happens when that viewer is gone.
  void send(ViewerId viewer, Frame frame);
  [[nodiscard]] std::size_t viewers() const;

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;  // keeps Boost out of everything else
};

}  // namespace interlace::monitor

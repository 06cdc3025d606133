#include "monitor/server/web_server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "monitor/server/http_session.hpp"
#include "monitor/server/viewer_session.hpp"

namespace interlace::monitor {

namespace net = boost::asio;
using boost::system::error_code;
using net::ip::tcp;

namespace {

constexpr std::chrono::milliseconds kAcceptPause{100};  // after the machine had no room for a connection
constexpr std::uint16_t kPortsTried = 20;               // from kDefaultPort on, before any

/// Binds `acceptor`, or says why not.
error_code try_port(tcp::acceptor& acceptor, const net::ip::address& address, std::uint16_t port) {
  error_code error;
  const tcp::endpoint endpoint{address, port};
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
  error_code ignored;
  if (error) acceptor.close(ignored);
  return error;
}

}  // namespace

struct WebServer::Impl {
  Impl(const ServerOptions& options, Bundle bundle, OnRequest on_request) : hub(options, std::move(bundle), std::move(on_request)) {
    error_code error;
    const auto address = net::ip::make_address(options.address, error);
    if (error) throw std::runtime_error{"'" + options.address + "' is no numeric address such as 127.0.0.1 or ::1"};
    hub.loopback = address.is_loopback();
    listen(address);
    accept();
    thread = std::thread{[this] { io.run(); }};
  }

  ~Impl() {
    io.stop();
    thread.join();
  }

  void listen(const net::ip::address& address) {
    error_code error;
    if (hub.options.port) {
      error = try_port(acceptor, address, *hub.options.port);
    } else {
      for (std::uint16_t i = 0; i < kPortsTried; ++i) {
        error = try_port(acceptor, address, static_cast<std::uint16_t>(kDefaultPort + i));
        if (error != net::error::address_in_use) break;
      }
      if (error == net::error::address_in_use) error = try_port(acceptor, address, 0);
    }
    const std::uint16_t wanted = hub.options.port.value_or(kDefaultPort);
    if (error)
      throw std::runtime_error{"cannot listen on " + hub.options.address + " port " + std::to_string(wanted) + ": " + error.message()};
    port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept([this](const error_code& error, tcp::socket socket) {
      if (error == net::error::operation_aborted) return;
      if (error) {  // no file descriptors, no memory: others may give some back
        pause.expires_after(kAcceptPause);
        return pause.async_wait([this](const error_code& stopped) {
          if (!stopped) accept();
        });
      }
      // Closing answers at once and costs nothing, which an error page would not.
      if (hub.connections < hub.options.connections) serve_http(hub, std::move(socket), Slot{hub});
      accept();
    });
  }

  Hub hub;
  net::io_context io{1};
  tcp::acceptor acceptor{io};
  net::steady_timer pause{io};
  std::uint16_t port = 0;
  std::thread thread;
};

WebServer::WebServer(const ServerOptions& options, Bundle bundle, OnRequest on_request)
    : impl_(std::make_unique<Impl>(options, std::move(bundle), std::move(on_request))) {}

WebServer::~WebServer() = default;

void WebServer::broadcast(Frame frame) {
  net::post(impl_->io, [impl = impl_.get(), frame = std::move(frame)] {
    for (const auto& [id, viewer] : impl->hub.viewers) {
      if (const auto alive = viewer.lock()) alive->push(frame);
    }
  });
}

void WebServer::send(ViewerId viewer, Frame frame) {
  net::post(impl_->io, [impl = impl_.get(), viewer, frame = std::move(frame)] {
    const auto found = impl->hub.viewers.find(viewer);
    if (found == impl->hub.viewers.end()) return;
    if (const auto alive = found->second.lock()) alive->push(frame);
  });
}

std::size_t WebServer::viewers() const {
  return impl_->hub.viewing;
}

std::uint16_t WebServer::port() const {
  return impl_->port;
}

std::string WebServer::url() const {
  const std::string& address = impl_->hub.options.address;
  const bool six = address.find(':') != std::string::npos;
  return "http://" + (six ? "[" + address + "]" : address) + ":" + std::to_string(impl_->port) + "/";
}

}  // namespace interlace::monitor

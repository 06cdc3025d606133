#include "monitor/server/viewer_session.hpp"

#include <boost/asio/buffer.hpp>

#include "monitor/server/access.hpp"

namespace interlace::monitor {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;

namespace {

constexpr std::chrono::seconds kHandshake{5};
constexpr std::chrono::seconds kIdle{30};  // without any sign of life; a ping is sent half way
constexpr int kRequestsPerSecond = 20;
constexpr int kSendBuffer = 128 * 1024;  // what the kernel holds for a viewer is not fresh any more, and is bounded too [bytes]

}  // namespace

ViewerSession::ViewerSession(Hub& hub, ViewerId id, tcp::socket socket, Slot slot)
    : hub_(hub), id_(id), slot_(std::move(slot)), stream_(std::move(socket)), buffer_(4 * kMaxViewerMessage), queue_(hub.options.queue) {
  ++hub_.viewing;
}

ViewerSession::~ViewerSession() {
  hub_.viewers.erase(id_);
  --hub_.viewing;
}

void ViewerSession::accept(UpgradeRequest request) {
  request_ = std::move(request);
  beast::error_code ignored;
  beast::get_lowest_layer(stream_).socket().set_option(boost::asio::socket_base::send_buffer_size{kSendBuffer}, ignored);
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = kHandshake;
  timeout.idle_timeout = kIdle;
  timeout.keep_alive_pings = true;
  stream_.set_option(timeout);
  stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    for (const auto& [name, value] : security_headers()) {
      response.set(boost::string_view{name.data(), name.size()}, boost::string_view{value.data(), value.size()});
    }
  }));
  stream_.read_message_max(kMaxViewerMessage);
  stream_.auto_fragment(false);
  stream_.text(true);
  stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    self->open_ = true;
    self->ask_for_snapshot();
    self->read();
  });
}

void ViewerSession::ask_for_snapshot() {
  if (snapshot_asked_) return;
  snapshot_asked_ = true;
  hub_.on_request(id_, SnapshotRequest{});
}

void ViewerSession::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) {
      self->open_ = false;
      return;
    }
    self->on_message();
  });
}

void ViewerSession::on_message() {
  const auto now = std::chrono::steady_clock::now();
  if (now - second_ >= std::chrono::seconds{1}) {
    second_ = now;
    asked_ = 0;
  }
  if (++asked_ > kRequestsPerSecond) return end(websocket::close_code::policy_error);
  if (!stream_.got_text()) return end(websocket::close_code::unknown_data);
  const auto request = parse_viewer_request(beast::buffers_to_string(buffer_.data()));
  buffer_.consume(buffer_.size());
  if (!request) return end(websocket::close_code::policy_error);
  if (std::holds_alternative<SnapshotRequest>(*request)) {
    ask_for_snapshot();
  } else {
    hub_.on_request(id_, *request);
  }
  read();
}

void ViewerSession::push(const Frame& frame) {
  if (!open_) return;
  if (frame.kind == FrameKind::snapshot) snapshot_asked_ = false;
  queue_.push(frame);
  if (!writing_) write_next();
}

void ViewerSession::write_next() {
  writing_ = open_ ? queue_.pop() : nullptr;
  if (!writing_) {
    if (open_ && queue_.wants_snapshot()) ask_for_snapshot();
    return;
  }
  stream_.async_write(boost::asio::buffer(*writing_), [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) {
      self->open_ = false;
      beast::get_lowest_layer(self->stream_).close();  // ends the read too
      return;
    }
    self->write_next();
  });
}

void ViewerSession::end(websocket::close_code why) {
  open_ = false;
  stream_.async_close(why, [self = shared_from_this()](beast::error_code) {});
}

void serve_viewer(Hub& hub, tcp::socket socket, UpgradeRequest request, Slot slot) {
  const ViewerId id = ++hub.last_viewer;
  const auto viewer = std::make_shared<ViewerSession>(hub, id, std::move(socket), std::move(slot));
  hub.viewers[id] = viewer;
  viewer->accept(std::move(request));
}

}  // namespace interlace::monitor

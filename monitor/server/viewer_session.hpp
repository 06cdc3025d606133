#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "monitor/server/hub.hpp"

namespace interlace::monitor {

using UpgradeRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// One viewer: writes the frames that wait for it one by one, and hears what it asks. Ends when the viewer closes, breaks a rule or does
/// not answer for half a minute. Belongs to the server's thread.
class ViewerSession : public std::enable_shared_from_this<ViewerSession> {
 public:
  ViewerSession(Hub& hub, ViewerId id, boost::asio::ip::tcp::socket socket, Slot slot);
  ~ViewerSession();

  void accept(UpgradeRequest request);
  void push(const Frame& frame);

 private:
  void read();
  void on_message();
  void write_next();
  void ask_for_snapshot();
  void end(boost::beast::websocket::close_code why);

  Hub& hub_;
  ViewerId id_;
  Slot slot_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  UpgradeRequest request_;
  boost::beast::flat_buffer buffer_;
  FrameQueue queue_;
  std::shared_ptr<const std::string> writing_;
  bool open_ = false;
  bool snapshot_asked_ = false;
  std::chrono::steady_clock::time_point second_{};  // in which `asked_` are counted
  int asked_ = 0;
};

/// Makes the connection a viewer. Keeps itself alive.
void serve_viewer(Hub& hub, boost::asio::ip::tcp::socket socket, UpgradeRequest request, Slot slot);

}  // namespace interlace::monitor

#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "monitor/server/hub.hpp"

namespace interlace::monitor {

/// Answers the requests of one connection until it closes, breaks a rule, is too slow or becomes a viewer. Keeps itself alive.
void serve_http(Hub& hub, boost::asio::ip::tcp::socket socket, Slot slot);

}  // namespace interlace::monitor

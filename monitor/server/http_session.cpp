#include "monitor/server/http_session.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>

#include "monitor/server/access.hpp"
#include "monitor/server/viewer_session.hpp"

namespace interlace::monitor {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::asio::ip::tcp;

namespace {

constexpr std::chrono::seconds kPatience{5};    // for a whole request, and for its answer to be taken
constexpr std::uint32_t kMaxHeader = 8 * 1024;  // [bytes]
constexpr int kMaxRequests = 200;               // of one connection

std::string text_of(boost::string_view view) {
  return {view.data(), view.size()};
}

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Hub& hub, tcp::socket socket, Slot slot) : hub_(hub), stream_(std::move(socket)), slot_(std::move(slot)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeader);
    parser_->body_limit(0);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
  }

 private:
  void on_read(beast::error_code error) {
    if (error == http::error::end_of_stream || error == beast::error::timeout) return close();
    if (error == http::error::header_limit) return refuse({431, "the header is too long"}, true);
    if (error == http::error::body_limit || error == http::error::unexpected_body) return refuse({413, "no body is taken"}, true);
    // What is no HTTP at all gets an answer too; a connection that broke gets none.
    if (error)
      return error.category() == http::make_error_code(http::error::bad_method).category() ? refuse({400, error.message()}, true) : close();
    const auto& request = parser_->get();
    const bool upgrade = beast::websocket::is_upgrade(request);
    const RequestHead head{text_of(request.method_string()), text_of(request.target()), text_of(request[http::field::host]),
                           text_of(request[http::field::origin]), upgrade};
    if (const Refusal refusal = judge(head, hub_.loopback); refusal.status != 0) return refuse(refusal, upgrade || !request.keep_alive());
    if (upgrade) {
      if (hub_.viewers.size() >= hub_.options.viewers) return refuse({503, "too many viewers look on already"}, true);
      return serve_viewer(hub_, stream_.release_socket(), parser_->release(), std::move(*slot_));
    }
    const BundleFile* file = hub_.bundle.find(head.target);
    if (file == nullptr) return refuse({404, "there is no such page"}, !request.keep_alive());
    answer(http::status::ok, file->type, file->body, file->immutable, !request.keep_alive());
  }

  void refuse(const Refusal& refusal, bool last) {
    text_ = refusal.text + "\n";
    answer(static_cast<http::status>(refusal.status), "text/plain; charset=utf-8", text_, false, last);
  }

  void answer(http::status status, const std::string& type, const std::string& body, bool immutable, bool last) {
    const bool head = parser_->get().method() == http::verb::head;
    response_.emplace();
    response_->version(11);
    response_->result(status);
    response_->set(http::field::content_type, type);
    response_->set(http::field::cache_control, immutable ? "public, max-age=31536000, immutable" : "no-cache");
    if (status == http::status::method_not_allowed) response_->set(http::field::allow, "GET, HEAD");
    if (status == http::status::upgrade_required) response_->set(http::field::upgrade, "websocket");
    for (const auto& [name, value] : security_headers()) {
      response_->set(boost::string_view{name.data(), name.size()}, boost::string_view{value.data(), value.size()});
    }
    response_->body() = {body.data(), head ? 0 : body.size()};
    response_->content_length(body.size());
    response_->keep_alive(!last && ++requests_ < kMaxRequests);
    stream_.expires_after(kPatience);
    http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || !self->response_->keep_alive()) return self->close();
      self->read();
    });
  }

  void close() {
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.close();
  }

  Hub& hub_;
  beast::tcp_stream stream_;
  std::optional<Slot> slot_;
  beast::flat_buffer buffer_{kMaxHeader + 1024};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::response<http::span_body<const char>>> response_;
  std::string text_;
  int requests_ = 0;
};

}  // namespace

void serve_http(Hub& hub, tcp::socket socket, Slot slot) {
  std::make_shared<HttpSession>(hub, std::move(socket), std::move(slot))->read();
}

}  // namespace interlace::monitor

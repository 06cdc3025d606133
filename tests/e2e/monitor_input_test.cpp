// What strangers may send to interlace-monitor: all of it is refused or bounded, and a viewer who behaves is not disturbed.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/support/web_client.hpp"

namespace interlace::test {
namespace {

const std::string kHost = "Host: 127.0.0.1\r\n";

/// The real program beside nothing else, with a page of one file, and a viewer who behaves.
class MonitorInput : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.file("index.html", "<!doctype html><title>page</title>");
    const std::string url = cell_.start_monitor({"--page", scratch_.path("")});
    ASSERT_FALSE(url.empty());
    port_ = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
    viewer_.emplace(port_);
    ASSERT_TRUE(viewer_->look_on(port_, kPatience));
    ASSERT_TRUE(viewer_->next_frame(kPatience));
  }

  /// The viewer gets poses that were measured after this was asked; nothing that waited unseen counts.
  void expect_undisturbed(const std::string& after) {
    const auto start = std::chrono::steady_clock::now();
    for (int poses = 0; poses < 5;) {
      const auto text = viewer_->next_frame(kPatience);
      ASSERT_TRUE(text) << "the viewer was cut off after: " << after;
      poses += text->find("\"type\":\"pose\"") != std::string::npos && std::chrono::steady_clock::now() - start > 50ms ? 1 : 0;
    }
    WebClient client{port_};
    client.send("GET / HTTP/1.1\r\n" + kHost + "\r\n");
    const auto head = client.head(kPatience);
    ASSERT_TRUE(head && head->rfind("HTTP/1.1 200", 0) == 0) << "the page is not served any more after: " << after;
  }

  /// What comes back until the connection is closed, or once a whole answer is there.
  std::string answer(const std::string& bytes) {
    WebClient client{port_};
    client.send(bytes);
    return client.head(kPatience).value_or("");
  }

  Scratch scratch_;
  RunningCell cell_{unique_domain(), "exp-4-2", deployed("exp-4-2/cell.yaml")};
  std::uint16_t port_ = 0;
  std::optional<WebClient> viewer_;
};

TEST_F(MonitorInput, RequestsThatAreNoneAreRefused) {
  const std::string many(20'000, 'a');
  const std::vector<std::string> refused = {
      "\r\n\r\n\r\n",
      "GET\r\n\r\n",
      "GET /\r\n\r\n",
      "GET / HTTP/9.9\r\n" + kHost + "\r\n",
      "GET / HTTP/1.1\r\n\r\n",                                        // no Host
      "GET / HTTP/1.1\r\nHost: elsewhere.example\r\n\r\n",             // a name made to point here
      "GET  / HTTP/1.1\r\n" + kHost + "\r\n",                          // two blanks
      "get / HTTP/1.1\r\n" + kHost + "\r\n",                           // another method
      "POST / HTTP/1.1\r\n" + kHost + "Content-Length: 3\r\n\r\nabc",  // a body
      "GET / HTTP/1.1\r\n" + kHost + "Content-Length: 99999999999999999999\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "bad header\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + ": none\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "A: \x01\r\n\r\n",
      "GET / HTTP/1.1\r\n" + kHost + "A: " + many + "\r\n\r\n",            // a header that is too long
      "GET /" + many + " HTTP/1.1\r\n" + kHost + "\r\n",                   // a line that is too long
      "GET /" + std::string(600, 'a') + " HTTP/1.1\r\n" + kHost + "\r\n",  // a target that is too long
      std::string("GET /\0 HTTP/1.1\r\n", 18) + kHost + "\r\n",
      "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + std::string(200, '\x7f') + "\r\n\r\n",  // TLS
      "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
      "GET http://127.0.0.1/ HTTP/1.1\r\n" + kHost + "\r\n",
      "GET /live HTTP/1.1\r\n" + kHost + "\r\n",  // no upgrade
      "GET /live HTTP/1.1\r\n" + kHost +
          "Origin: http://elsewhere.example\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
          "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
      "GET /live HTTP/1.1\r\n" + kHost +
          "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 12\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
      "GET /other HTTP/1.1\r\n" + kHost +
          "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
          "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"};
  for (const std::string& bytes : refused) {
    const std::string head = answer(bytes);
    EXPECT_TRUE(head.empty() || head.rfind("HTTP/1.1 4", 0) == 0) << testing::PrintToString(bytes.substr(0, 80)) << "\n" << head;
  }
  expect_undisturbed("bad requests");
}

TEST_F(MonitorInput, NoPathLeadsOutOfThePage) {
  scratch_.file("secret.key", "not of the page");
  for (const char* target : {"/../secret.key", "/secret.key", "/..%2fsecret.key", "/%2e%2e/secret.key", "/%2e%2e%2fsecret.key",
                             "/..%5csecret.key", "/.%00./secret.key", "/%252e%252e%252fsecret.key", "/..\\secret.key",
                             "/assets/../../secret.key", "//etc/passwd", "/../../../../../../etc/passwd", "/%c0%ae%c0%ae/etc/passwd",
                             "/./././etc/passwd", "/index.html/../secret.key", "/file:///etc/passwd", "/proc/self/environ"}) {
    const std::string head = answer("GET " + std::string{target} + " HTTP/1.1\r\n" + kHost + "\r\n");
    EXPECT_TRUE(head.rfind("HTTP/1.1 404", 0) == 0 || head.rfind("HTTP/1.1 400", 0) == 0) << target << "\n" << head;
  }
  expect_undisturbed("paths");
}

TEST_F(MonitorInput, FramesThatNoViewerSendsEndThatViewerOnly) {
  const auto masked = WebClient::masked;
  std::string flood;
  for (int i = 0; i < 100; ++i) flood += masked(0x81, R"({"type":"map","command":"a"})");
  const std::vector<std::string> bad = {
      std::string("\x81\x02{}", 4),                                                 // not masked
      masked(0xf1, "{}"),                                                           // reserved bits
      masked(0x83, "{}"),                                                           // an opcode that is none
      masked(0x82, "{}"),                                                           // binary
      masked(0x81, "{}"),                                                           // nothing that can be asked
      masked(0x81, "[[[[[["),                                                       // no JSON
      masked(0x81, "\xff\xfe\xfd"),                                                 // no UTF-8
      masked(0x81, std::string(5000, 'a')),                                         // too long
      std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\x01\x02\x03\x04", 14),  // 2^63 bytes announced
      masked(0x09, "a"),                                                            // a ping in pieces
      masked(0x89, std::string(126, 'a')),                                          // a ping that is too long
      masked(0x80, "a"),                                                            // goes on with nothing
      masked(0x88, "\x03"),                                                         // half a reason to close
      flood};
  for (const std::string& bytes : bad) {
    WebClient client{port_};
    ASSERT_TRUE(client.look_on(port_, kPatience));
    client.send(bytes);
    EXPECT_TRUE(client.ends(kPatience)) << "still open after " << testing::PrintToString(bytes.substr(0, 40));
  }
  expect_undisturbed("bad frames");
}

TEST_F(MonitorInput, AThousandConnectionsAreBoundedAndDisturbNobody) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, 4096);
  ::setrlimit(RLIMIT_NOFILE, &files);
  {
    std::vector<WebClient> crowd;
    crowd.reserve(1000);
    for (int i = 0; i < 1000; ++i) {
      crowd.emplace_back(port_);
      crowd.back().send("GET / HT");  // and never goes on
    }
    // All but those that are served at a time are closed at once; these too, when they have not asked in time.
    std::size_t closed = 0;
    for (WebClient& client : crowd) closed += client.until_closed(kPatience) ? 1 : 0;
    EXPECT_EQ(closed, crowd.size());
  }
  expect_undisturbed("a thousand connections");
}

TEST_F(MonitorInput, EndsInGoodOrderWhileSomebodyLooksOn) {
  Process& monitor = cell_.monitor();
  monitor.kill(SIGTERM);
  EXPECT_EQ(monitor.wait(kPatience), 0);
}

}  // namespace
}  // namespace interlace::test

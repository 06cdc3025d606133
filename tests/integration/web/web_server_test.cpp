#include "monitor/server/web_server.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "tests/support/web_client.hpp"

namespace interlace::monitor {
namespace {

using namespace std::chrono_literals;
using test::WebClient;

constexpr auto kPatience = 20s;

Frame frame(FrameKind kind, const std::string& text) {
  return {kind, std::make_shared<const std::string>(text)};
}

/// Memory of this process [kB].
long resident() {
  std::ifstream status{"/proc/self/status"};
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stol(line.substr(6));
  }
  return 0;
}

/// A server with a page of one file, which answers each request for a snapshot at once.
class WebServerTest : public testing::Test {
 protected:
  static ServerOptions options() {
    ServerOptions o;
    o.port = 0;
    o.viewers = 4;
    return o;
  }
  static Bundle page() {
    Bundle bundle;
    bundle.add("/index.html", {"text/html; charset=utf-8", "<!doctype html><title>page</title>", false});
    return bundle;
  }
  void on_request(ViewerId viewer, const ViewerRequest& request) {
    const std::lock_guard lock{mutex_};
    if (const auto* map = std::get_if<MapRequest>(&request)) maps_.push_back(map->command.str());
    viewers_.push_back(viewer);
    asked_.notify_all();
  }
  /// Answers as the node does: from another thread than the server's.
  ViewerId answer_next() {
    std::unique_lock lock{mutex_};
    if (!asked_.wait_for(lock, kPatience, [&] { return !viewers_.empty(); })) return 0;
    const ViewerId viewer = viewers_.front();
    viewers_.erase(viewers_.begin());
    lock.unlock();
    server_.send(viewer, frame(FrameKind::snapshot, "snapshot"));
    return viewer;
  }
  WebClient viewer(int receive_buffer = 0) {
    WebClient client{server_.port(), receive_buffer};
    EXPECT_TRUE(client.look_on(server_.port(), kPatience));
    EXPECT_NE(answer_next(), 0U);
    return client;
  }
  std::string request(const std::string& target) const {
    return "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.port()) + "\r\n\r\n";
  }

  std::mutex mutex_;
  std::condition_variable asked_;
  std::vector<ViewerId> viewers_;
  std::vector<std::string> maps_;
  WebServer server_{options(), page(), [this](ViewerId viewer, const ViewerRequest& r) { on_request(viewer, r); }};
};

TEST_F(WebServerTest, ServesThePageWithHeadersThatLetNothingElseRun) {
  WebClient client{server_.port()};
  client.send(request("/"));
  const auto head = client.head(kPatience);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->rfind("HTTP/1.1 200", 0), 0U) << *head;
  for (const char* header : {"Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff", "Content-Length: 34",
                             "Content-Type: text/html; charset=utf-8"}) {
    EXPECT_NE(head->find(header), std::string::npos) << header << " in\n" << *head;
  }
  client.send(request("/nowhere"));
  const auto second = client.head(kPatience);
  ASSERT_TRUE(second) << "the connection goes on";
}

TEST_F(WebServerTest, AViewerGetsItsSnapshotAndThenEverything) {
  WebClient client = viewer();
  EXPECT_EQ(client.next_frame(kPatience).value_or(""), "snapshot");
  server_.broadcast(frame(FrameKind::event, "one"));
  server_.broadcast(frame(FrameKind::event, "two"));
  EXPECT_EQ(client.next_frame(kPatience).value_or(""), "one");
  EXPECT_EQ(client.next_frame(kPatience).value_or(""), "two");
  client.send(WebClient::masked(0x81, R"({"type":"map","command":"r1-3"})"));
  ASSERT_NE(answer_next(), 0U);
  EXPECT_EQ(maps_, std::vector<std::string>{"r1-3"});
  EXPECT_EQ(server_.viewers(), 1U);
}

TEST_F(WebServerTest, NoMoreViewersThanAllowedAndTheOthersAreNotDisturbed) {
  std::vector<WebClient> viewers;
  for (int i = 0; i < 4; ++i) viewers.push_back(viewer());
  WebClient late{server_.port()};
  EXPECT_FALSE(late.look_on(server_.port(), kPatience));
  server_.broadcast(frame(FrameKind::event, "still here"));
  for (WebClient& v : viewers) {
    EXPECT_EQ(v.next_frame(kPatience).value_or(""), "snapshot");
    EXPECT_EQ(v.next_frame(kPatience).value_or(""), "still here");
  }
}

TEST_F(WebServerTest, AStoppedViewerCostsBoundedMemoryIsToldWhatItMissedAndDisturbsNobody) {
  WebClient stopped = viewer(4096);
  WebClient reading = viewer();
  EXPECT_EQ(reading.next_frame(kPatience).value_or(""), "snapshot");
  const std::string pose = R"({"type":"pose","fill":")" + std::string(20'000, 'x') + "\"}";
  const std::string event = R"({"type":"command","fill":")" + std::string(2'000, 'y') + "\"}";
  constexpr int kRounds = 4000;  // 88 MB for each viewer
  const auto play = [&](int rounds) {
    for (int i = 0; i < rounds; ++i) {
      server_.broadcast(frame(FrameKind::pose, pose));
      server_.broadcast(frame(FrameKind::event, event));
      for (bool seen = false; !seen;) {  // at the pace of the one who reads
        const auto text = reading.next_frame(kPatience);
        ASSERT_TRUE(text) << "round " << i;
        seen = *text == event;
      }
    }
  };
  play(kRounds / 4);
  const long before = resident();
  play(3 * kRounds / 4);
  EXPECT_LT(resident() - before, 8 * 1024) << "kB more after 66 MB that nobody read";

  EXPECT_EQ(stopped.next_frame(kPatience).value_or(""), "snapshot");
  // It reads again. What the kernel had taken comes first; then the server asks for a snapshot, before which the viewer is told.
  std::thread answering{[this] { EXPECT_NE(answer_next(), 0U); }};
  bool told = false;
  for (std::string text; text != "snapshot";) {
    const auto next = stopped.next_frame(kPatience);
    if (!next) break;
    text = *next;
    told = told || text.rfind(R"({"type":"skipped","frames":)", 0) == 0;
  }
  answering.join();
  EXPECT_TRUE(told);
  server_.broadcast(frame(FrameKind::event, "after"));
  EXPECT_EQ(stopped.next_frame(kPatience).value_or("nothing"), "after");
}

TEST_F(WebServerTest, EndsWithViewersThatDoNotRead) {
  WebClient stopped = viewer(4096);
  for (int i = 0; i < 200; ++i) server_.broadcast(frame(FrameKind::event, std::string(10'000, 'x')));
}

TEST(WebServer, SaysWhyAnAddressCannotBeHad) {
  ServerOptions options;
  options.port = 0;
  const WebServer first{options, {}, [](ViewerId, const ViewerRequest&) {}};
  options.port = first.port();
  EXPECT_THROW((WebServer{options, {}, [](ViewerId, const ViewerRequest&) {}}), std::runtime_error);
  options.port.reset();
  const WebServer another{options, {}, [](ViewerId, const ViewerRequest&) {}};
  const WebServer third{options, {}, [](ViewerId, const ViewerRequest&) {}};
  EXPECT_NE(another.port(), third.port()) << "without a port of its own it takes one that is free";
  options.address = "localhost";
  EXPECT_THROW((WebServer{options, {}, [](ViewerId, const ViewerRequest&) {}}), std::runtime_error);
}

}  // namespace
}  // namespace interlace::monitor

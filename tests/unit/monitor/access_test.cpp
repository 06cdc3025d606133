#include "monitor/server/access.hpp"

#include <gtest/gtest.h>

namespace interlace::monitor {
namespace {

RequestHead page() {
  return {"GET", "/", "127.0.0.1:8088", "", false};
}

unsigned status(const RequestHead& head, bool loopback = true) {
  return judge(head, loopback).status;
}

TEST(Access, ThePageAndTheLiveSocketAreServed) {
  EXPECT_EQ(status(page()), 0U);
  RequestHead live{"GET", "/live", "localhost:8088", "http://localhost:8088", true};
  EXPECT_EQ(status(live), 0U);
  live.host = "[::1]:8088";
  live.origin = "http://[::1]:8088";
  EXPECT_EQ(status(live), 0U);
}

TEST(Access, PagesOfOtherSitesAreNotLetIn) {
  RequestHead live{"GET", "/live", "127.0.0.1:8088", "http://elsewhere.example", true};
  EXPECT_EQ(status(live), 403U);
  EXPECT_EQ(status(live, false), 403U);
  live.origin = "null";
  EXPECT_EQ(status(live), 403U);
  live.origin = "http://127.0.0.1:9000";
  EXPECT_EQ(status(live), 403U) << "another program on this machine";
}

TEST(Access, ANameThatWasMadeToPointHereIsNotServed) {
  RequestHead head = page();
  for (const char* host : {"elsewhere.example:8088", "127.0.0.1.elsewhere.example", "localhost.elsewhere.example", "0.0.0.0:8088"}) {
    head.host = host;
    EXPECT_EQ(status(head), 403U) << host;
    EXPECT_EQ(status(head, false), 0U) << "on a network any name may be its own: " << host;
  }
}

TEST(Access, OnlyPathsAreTargetsAndOnlySoLong) {
  RequestHead head = page();
  for (const char* target : {"", "*", "http://127.0.0.1/", "index.html"}) {
    head.target = target;
    EXPECT_EQ(status(head), 400U) << target;
  }
  head.target = "/" + std::string(kMaxTarget, 'a');
  EXPECT_EQ(status(head), 414U);
}

TEST(Access, NothingIsEverChangedHere) {
  RequestHead head = page();
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "get", ""}) {
    head.method = method;
    EXPECT_EQ(status(head), 405U) << method;
  }
}

TEST(Access, ASocketIsWhereItIsAndNowhereElse) {
  RequestHead head = page();
  head.upgrade = true;
  EXPECT_EQ(status(head), 404U);
  head.target = "/live";
  head.upgrade = false;
  EXPECT_EQ(status(head), 426U);
  head.host.clear();
  EXPECT_EQ(status(head), 400U);
}

}  // namespace
}  // namespace interlace::monitor

#include "monitor/server/viewer_request.hpp"

#include <gtest/gtest.h>

namespace interlace::monitor {
namespace {

TEST(ViewerRequest, AsksForAMapOrForEverything) {
  const auto map = parse_viewer_request(R"({"type": "map", "command": "r1-3"})");
  ASSERT_TRUE(map && std::holds_alternative<MapRequest>(*map));
  EXPECT_EQ(std::get<MapRequest>(*map).command.str(), "r1-3");
  const auto all = parse_viewer_request(R"({"type": "snapshot", "more": [1, 2]})");
  EXPECT_TRUE(all && std::holds_alternative<SnapshotRequest>(*all));
}

TEST(ViewerRequest, TellsAPlayerWhatToDo) {
  const auto play = parse_viewer_request(R"({"type": "play", "speed": 0.25})");
  ASSERT_TRUE(play && std::holds_alternative<PlayRequest>(*play));
  EXPECT_EQ(std::get<PlayRequest>(*play).speed, 0.25);
  EXPECT_EQ(std::get<PlayRequest>(parse_viewer_request(R"({"type": "play"})").value()).speed, 1);
  EXPECT_TRUE(std::holds_alternative<PauseRequest>(parse_viewer_request(R"({"type": "pause"})").value()));
  EXPECT_EQ(std::get<SeekRequest>(parse_viewer_request(R"({"type": "seek", "t": 12.5})").value()).t, 12.5);
}

TEST(ViewerRequest, AnythingElseIsNone) {
  const std::string deep(400, '[');
  for (const std::string& text : {std::string{},
                                  std::string{"{"},
                                  std::string{"null"},
                                  std::string{"[]"},
                                  std::string{"\"map\""},
                                  deep,
                                  std::string{"\xff\xfe"},
                                  std::string{R"({"type": "map"})"},
                                  std::string{R"({"type": "map", "command": 7})"},
                                  std::string{R"({"type": "map", "command": ""})"},
                                  std::string{R"({"type": "map", "command": "../etc"})"},
                                  std::string{R"({"type": ["map"], "command": "a"})"},
                                  std::string{R"({"type": "dispatch", "command": "a"})"},
                                  std::string{R"({"type": "play", "speed": 0})"},
                                  std::string{R"({"type": "play", "speed": -1})"},
                                  std::string{R"({"type": "play", "speed": 1e300})"},
                                  std::string{R"({"type": "play", "speed": "fast"})"},
                                  std::string{R"({"type": "seek"})"},
                                  std::string{R"({"type": "seek", "t": -1})"},
                                  std::string{R"({"type": "seek", "t": 1e999})"},
                                  R"({"type": "map", "command": ")" + std::string(65, 'a') + R"("})",
                                  R"({"type": "snapshot", "x": ")" + std::string(kMaxViewerMessage, 'a') + R"("})"}) {
    EXPECT_FALSE(parse_viewer_request(text)) << text;
  }
}

}  // namespace
}  // namespace interlace::monitor

#include "monitor/playback.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "recording/recording_writer.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/unit/monitor/cells.hpp"

// Recordings in the view, in time that the test makes.
namespace interlace::monitor {
namespace {

using namespace std::chrono_literals;
using test::parsed;

constexpr double kLength = 10;                               // [s]
constexpr std::uint64_t kBegin = 1'700'000'000'000'000'000;  // the recorder's wall clock at its begin [ns]
constexpr std::size_t kAll = 1'000'000;

const Playback::RealTime kNow{5h};

/// Ten seconds of two arms: the first turns, once a second something becomes of a command.
class PlaybackTest : public testing::Test {
 protected:
  PlaybackTest() {
    auto out = recording::RecordingWriter::create(file_, false).value();
    out->attach_cell(test::kTwoArms, kBegin);
    for (int i = 0; i <= 100 * static_cast<int>(kLength); ++i) {
      const double t = 0.01 * i;
      const auto at = kBegin + 10'000'000ULL * static_cast<std::uint64_t>(i);
      if (i % 10 == 0) {
        dds::Heartbeat beat;
        beat.robot = model::RobotName{"r1"};
        beat.planner_sent = model::at_seconds(t);
        out->write(dds::topics::dispatch("two", beat.robot), at, at, dds::encode(dds::DispatchMessage{7, cell_.fingerprint, beat}));
      }
      for (const model::Robot& robot : cell_.cell.robots) {
        dds::PostureMessage m;
        m.fingerprint = cell_.fingerprint;
        m.proxy_incarnation = 1;
        m.planner_incarnation = 7;
        m.posture.robot = robot.name;
        m.posture.at = model::at_seconds(t);
        m.posture.joints = robot.start;
        if (robot.name.str() == "r1") m.posture.joints[0] += turned(t);
        out->write(dds::topics::posture("two", robot.name), at, at, dds::encode(m));
      }
      if (i % 100 != 50) continue;
      model::CommandStatus s;
      s.id = model::CommandId{"c-" + std::to_string(i / 100)};
      s.robot = model::RobotName{"r1"};
      out->write(dds::topics::command_status("two", s.robot), at, at, dds::encode(dds::StatusMessage{7, s}));
    }
    EXPECT_TRUE(out->close());
  }

  static double turned(double t) { return -0.02 * t; }
  [[nodiscard]] std::unique_ptr<Playback> open() const { return Playback::open(file_, {}).value(); }

  /// How far r1 has turned in what is shown [rad].
  static double shown(Playback& playback) {
    const auto tip = parsed(playback.view().pose())["robots"][0]["ends"];
    const std::size_t n = tip.size();
    return std::atan2(tip[n - 2].get<double>() - 0.25, tip[n - 3].get<double>());
  }
  static std::size_t commands(Playback& playback) {
    std::size_t count = 0;
    const auto snapshot = parsed(playback.view().snapshot());
    for (const auto& frame : snapshot["frames"]) count += frame["type"] == "command" ? 1 : 0;
    return count;
  }

  test::Scratch scratch_;
  std::string file_ = scratch_.path("run.mcap");
  app::LoadedCell cell_ = test::two_arms();
};

TEST_F(PlaybackTest, GoesAtThePaceOfTheRecordingAndStopsAtItsEnd) {
  const auto playback = open();
  EXPECT_DOUBLE_EQ(playback->length(), kLength);
  playback->advance(kNow, kAll);
  EXPECT_EQ(playback->place(), 0);
  playback->play(1, kNow);
  playback->advance(kNow + 2s, kAll);
  EXPECT_DOUBLE_EQ(playback->place(), 2);
  EXPECT_NEAR(shown(*playback), turned(2), 1e-3);
  EXPECT_EQ(commands(*playback), 2);
  playback->play(4, kNow + 2s);
  playback->advance(kNow + 3s, kAll);
  EXPECT_DOUBLE_EQ(playback->place(), 6);
  playback->pause(kNow + 3s);
  playback->advance(kNow + 60s, kAll);
  EXPECT_DOUBLE_EQ(playback->place(), 6);
  playback->play(1, kNow + 60s);
  playback->advance(kNow + 100s, kAll);
  EXPECT_DOUBLE_EQ(playback->place(), kLength);
  EXPECT_FALSE(playback->playing());
  EXPECT_EQ(commands(*playback), 10);
  // From the begin again.
  playback->play(1, kNow + 100s);
  playback->advance(kNow + 100s, kAll);
  playback->advance(kNow + 101s, kAll);
  EXPECT_DOUBLE_EQ(playback->place(), 1);
  EXPECT_EQ(commands(*playback), 1);
}

TEST_F(PlaybackTest, ShowsTheSameAtAPlaceHoweverItGotThere) {
  const auto forth = open();
  forth->seek(5, kNow);
  forth->advance(kNow, kAll);
  EXPECT_TRUE(forth->take_arrived());
  EXPECT_FALSE(forth->take_arrived());
  const auto back = open();
  back->play(1, kNow);
  for (int i = 0; i < 300; ++i) back->advance(kNow + 30ms * i, kAll);
  EXPECT_GT(back->place(), 8.9);
  back->seek(5, kNow + 9s);
  back->advance(kNow + 9s, kAll);
  EXPECT_EQ(*forth->view().snapshot().text, *back->view().snapshot().text);
  EXPECT_NEAR(shown(*back), turned(5), 1e-3);
  EXPECT_EQ(commands(*back), 5);
  EXPECT_TRUE(back->playing()) << "it goes on from there";
  back->advance(kNow + 10s, kAll);
  EXPECT_DOUBLE_EQ(back->place(), 6);
}

TEST_F(PlaybackTest, GoesFarInStepsSoThatNobodyWaitsForIt) {
  const auto playback = open();
  playback->seek(1e9, kNow);
  std::size_t steps = 0;
  do {
    playback->advance(kNow, 100);
    ++steps;
    ASSERT_LE(steps, 30);
  } while (playback->seeking());
  EXPECT_GT(steps, 20);
  EXPECT_DOUBLE_EQ(playback->place(), kLength);
  EXPECT_EQ(parsed(playback->player())["error"], nullptr);
  // What cannot be shown as fast is shown slower.
  const auto slow = open();
  slow->play(50, kNow);
  slow->advance(kNow + 100ms, 100);
  EXPECT_GT(slow->place(), 0.4);
  EXPECT_LT(slow->place(), 0.6);
  slow->advance(kNow + 101ms, kAll);
  EXPECT_LT(slow->place(), 0.7);
}

TEST_F(PlaybackTest, TellsThePageThatItIsARecording) {
  const auto playback = open();
  playback->seek(3, kNow);
  playback->advance(kNow, kAll);
  const auto cell = parsed(playback->view().snapshot())["frames"][0];
  EXPECT_EQ(cell["source"], "recording");
  EXPECT_EQ(cell["range"], nlohmann::json::array({0.0, kLength}));
  const auto player = parsed(playback->player());
  EXPECT_EQ(player["type"], "player");
  EXPECT_EQ(player["t"], 3.0);
  EXPECT_EQ(player["playing"], false);
  EXPECT_EQ(player["speed"], 1.0);
}

TEST_F(PlaybackTest, RefusesWhatCannotBePlayed) {
  std::string text = test::read_text(file_);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  const auto broken = Playback::open(scratch_.file("broken.mcap", text), {});
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().find("broken.mcap: byte "), std::string::npos) << broken.error();
  EXPECT_FALSE(Playback::open(scratch_.path("nothing.mcap"), {}));
  EXPECT_FALSE(Playback::open(scratch_.file("text.mcap", "no recording"), {}));
  const std::string empty = scratch_.path("empty.mcap");
  ASSERT_TRUE(recording::RecordingWriter::create(empty, false).value()->close());
  EXPECT_EQ(Playback::open(empty, {}).error(), empty + ": there is no message in it");
}

}  // namespace
}  // namespace interlace::monitor

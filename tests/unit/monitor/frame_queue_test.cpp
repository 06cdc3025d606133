#include "monitor/server/frame_queue.hpp"

#include <gtest/gtest.h>

#include <string>

namespace interlace::monitor {
namespace {

Frame frame(FrameKind kind, const std::string& text) {
  return {kind, std::make_shared<const std::string>(text)};
}

std::string next(FrameQueue& queue) {
  const auto text = queue.pop();
  return text ? *text : "nothing";
}

TEST(FrameQueue, BeginsWithASnapshotAndLeavesOutWhatThatHasAnyway) {
  FrameQueue queue;
  queue.push(frame(FrameKind::event, "before"));
  EXPECT_TRUE(queue.wants_snapshot());
  EXPECT_EQ(next(queue), "nothing");
  queue.push(frame(FrameKind::snapshot, "snapshot"));
  queue.push(frame(FrameKind::event, "after"));
  EXPECT_FALSE(queue.wants_snapshot());
  EXPECT_EQ(next(queue), "snapshot");
  EXPECT_EQ(next(queue), "after");
  EXPECT_EQ(next(queue), "nothing");
  EXPECT_EQ(queue.skipped(), 0U) << "nothing was lost to this viewer";
}

TEST(FrameQueue, AWaitingPoseIsReplacedByTheNewerOneAndTold) {
  FrameQueue queue;
  queue.push(frame(FrameKind::snapshot, "s"));
  EXPECT_EQ(next(queue), "s");
  for (int i = 0; i < 5; ++i) queue.push(frame(FrameKind::pose, "pose " + std::to_string(i)));
  EXPECT_EQ(queue.size(), 1U);
  EXPECT_EQ(next(queue), R"({"type":"skipped","frames":4,"total":4})");
  EXPECT_EQ(next(queue), "pose 4");
  EXPECT_EQ(next(queue), "nothing");
}

TEST(FrameQueue, AViewerWhoStoppedCostsNoMoreThanTheLimitsAndStartsAgainWithASnapshot) {
  const QueueLimits limits{8, 1000};
  FrameQueue queue{limits};
  queue.push(frame(FrameKind::snapshot, "s"));
  EXPECT_EQ(next(queue), "s");
  for (int i = 0; i < 1000; ++i) {
    queue.push(frame(i % 3 == 0 ? FrameKind::event : FrameKind::pose, std::string(50, 'x')));
    ASSERT_LE(queue.size(), limits.frames);
    ASSERT_LE(queue.bytes(), limits.bytes);
  }
  EXPECT_TRUE(queue.wants_snapshot());
  EXPECT_EQ(queue.skipped(), 1000U);
  queue.push(frame(FrameKind::snapshot, "again"));
  EXPECT_EQ(next(queue), R"({"type":"skipped","frames":1000,"total":1000})");
  EXPECT_EQ(next(queue), "again");
}

TEST(FrameQueue, ASnapshotIsNeverDroppedForItsSize) {
  FrameQueue queue{{4, 10}};
  queue.push(frame(FrameKind::snapshot, std::string(1000, 's')));
  EXPECT_EQ(next(queue).size(), 1000U);
}

TEST(FrameQueue, TooManyBytesAreAsMuchAsTooManyFrames) {
  FrameQueue queue{{100, 100}};
  queue.push(frame(FrameKind::snapshot, "s"));
  queue.push(frame(FrameKind::event, std::string(60, 'x')));
  queue.push(frame(FrameKind::event, std::string(60, 'y')));
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.wants_snapshot());
}

}  // namespace
}  // namespace interlace::monitor

#include "monitor/server/frame_queue.hpp"

#include <algorithm>
#include <string>

namespace interlace::monitor {

void FrameQueue::push(const Frame& frame) {
  if (frame.kind == FrameKind::snapshot) {
    waiting_.clear();  // the snapshot has it
    bytes_ = 0;
    append(frame);
    current_ = true;
    return;
  }
  if (!current_) {
    if (skipped_ > 0) ++skipped_;
    return;
  }
  if (frame.kind == FrameKind::pose) drop_pose();
  if (waiting_.size() >= limits_.frames || bytes_ + frame.text->size() > limits_.bytes) {
    drop_all();
    ++skipped_;
    current_ = false;
    return;
  }
  append(frame);
}

std::shared_ptr<const std::string> FrameQueue::pop() {
  if (waiting_.empty()) return nullptr;
  if (told_ != skipped_) {
    const auto text = R"({"type":"skipped","frames":)" + std::to_string(skipped_ - told_) + R"(,"total":)" + std::to_string(skipped_) + "}";
    told_ = skipped_;
    return std::make_shared<const std::string>(text);
  }
  auto text = std::move(waiting_.front().text);
  waiting_.pop_front();
  bytes_ -= text->size();
  return text;
}

void FrameQueue::append(const Frame& frame) {
  waiting_.push_back(frame);
  bytes_ += frame.text->size();
}

void FrameQueue::drop_pose() {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [](const Frame& f) { return f.kind == FrameKind::pose; });
  if (found == waiting_.end()) return;
  bytes_ -= found->text->size();
  waiting_.erase(found);
  ++skipped_;
}

void FrameQueue::drop_all() {
  skipped_ += waiting_.size();
  waiting_.clear();
  bytes_ = 0;
}

}  // namespace interlace::monitor

#include "monitor/playback.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "monitor/numbers.hpp"
#include "recording/recorded_cell.hpp"

namespace interlace::monitor {
namespace {

/// The view's clock shows the place.
LiveView::LocalTime view_time(double t) {
  return LiveView::LocalTime{std::chrono::duration_cast<LiveView::LocalTime::duration>(std::chrono::duration<double>(t))};
}

/// Hands a message to the view.
struct Tell {
  LiveView& view;
  LiveView::LocalTime at;

  void operator()(const dds::CommandMessage& m) const { view.on_command(m); }
  void operator()(const dds::StatusMessage& m) const { view.on_status(m, at); }
  void operator()(const dds::DispatchMessage& m) const { view.on_dispatch(m, at); }
  void operator()(const dds::ExecutionMessage& m) const { view.on_execution(m, at); }
  void operator()(const dds::PostureMessage& m) const { view.on_posture(m, at); }
  void operator()(const model::PlannerState& m) const { view.on_state(m, at); }
  void operator()(const model::PlannerJournal& /*the view works from what everyone hears*/) const {}
};

constexpr double kStride = std::chrono::duration<double>(LiveView::kCurvePeriod).count();  // between two looks of the view [s]

}  // namespace

model::Result<std::unique_ptr<Playback>, std::string> Playback::open(const std::string& path, const std::string& cell_file) {
  auto reader = recording::RecordingReader::open(path);
  if (!reader) return model::unexpected{reader.error()};
  const auto extent = (*reader)->skim();
  if (!extent) return model::unexpected{extent.error()};
  if (extent->messages == 0) return model::unexpected{path + ": there is no message in it"};
  auto cell = recording::recorded_cell(**reader, path, cell_file);
  if (!cell) return model::unexpected{cell.error()};
  return std::unique_ptr<Playback>{new Playback{path, std::move(*cell), *extent}};
}

Playback::Playback(std::string path, app::LoadedCell cell, const recording::Extent& extent)
    : path_(std::move(path)), cell_(std::move(cell)), begin_(extent.from), length_(1e-9 * static_cast<double>(extent.until - extent.from)) {
  rewind();
}

void Playback::rewind() {
  view_ = std::make_unique<LiveView>(cell_, LiveView::LocalTime{}, length_);
  error_.clear();
  next_.reset();
  place_ = passed_ = 0;
  auto reader = recording::RecordingReader::open(path_);
  reader_ = reader ? std::move(*reader) : nullptr;
  if (!reader) error_ = reader.error();  // it was there when this was opened
  if (reader_) reader_->leave_out_journal();
  fetch();
}

void Playback::fetch() {
  next_.reset();
  if (!reader_ || !error_.empty()) return;
  auto read = reader_->next();
  if (read) {
    next_ = std::move(*read);
  } else {
    error_ = read.error();
  }
}

double Playback::wanted(RealTime now) const {
  const double run = playing_ && !seeking_ ? speed_ * std::chrono::duration<double>(now - since_).count() : 0;
  return std::clamp(from_ + run, 0.0, length_);
}

void Playback::play(double speed, RealTime now) {
  if (!playing_ && place_ >= length_) seek(0, now);
  from_ = wanted(now);
  since_ = now;
  speed_ = speed;
  playing_ = true;
}

void Playback::pause(RealTime now) {
  from_ = wanted(now);
  playing_ = false;
}

void Playback::seek(double t, RealTime now) {
  from_ = std::clamp(t, 0.0, length_);
  since_ = now;
  seeking_ = true;
  if (from_ < place_) rewind();
}

/// The view looks around at least every stride, so that what is only seen in passing is seen.
void Playback::pass_until(double t) {
  for (; passed_ + kStride <= t; passed_ += kStride) view_->advance(view_time(passed_ + kStride));
}

void Playback::advance(RealTime now, std::size_t most) {
  const double until = wanted(now);
  std::size_t told = 0;
  for (; next_ && told < most; ++told) {
    // Times within a file may go back by a little: what was received is never told before what was received earlier.
    const double t = next_->log_time <= begin_ ? 0 : 1e-9 * static_cast<double>(next_->log_time - begin_);
    if (t > until) break;
    pass_until(t);
    place_ = std::max(place_, t);
    std::visit(Tell{*view_, view_time(place_)}, next_->message);
    fetch();
  }
  if (next_ && told == most) {
    if (seeking_) return;
    from_ = place_;  // it cannot be shown as fast
    since_ = now;
  } else {
    pass_until(until);
    place_ = until;
  }
  view_->advance(view_time(place_));
  if (seeking_) {
    seeking_ = false;
    arrived_ = true;
    since_ = now;
  }
  if (playing_ && place_ >= length_) pause(now);
}

Frame Playback::player() const {
  const nlohmann::json json{{"type", "player"},    {"t", seconds(place_)},
                            {"playing", playing_}, {"speed", speed_},
                            {"seeking", seeking_}, {"error", error_.empty() ? nlohmann::json(nullptr) : nlohmann::json(error_)}};
  return {FrameKind::event, std::make_shared<const std::string>(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))};
}

}  // namespace interlace::monitor

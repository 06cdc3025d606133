#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "monitor/live_view.hpp"
#include "recording/recording_reader.hpp"

namespace interlace::monitor {

/// Plays a recording into a LiveView: faster, slower, from any place, with one place for all who look on. Real time comes in with the
/// calls; the file is all it reads. Places are seconds from the recording's begin. Not thread-safe.
class Playback {
 public:
  using RealTime = std::chrono::steady_clock::time_point;

  /// Opens the recording at `path` and reads over it once: a broken file is refused here, with the place. `cell_file` stands in for a cell
  /// file that is not in it. It stands at its begin. The error is a sentence.
  [[nodiscard]] static model::Result<std::unique_ptr<Playback>, std::string> open(const std::string& path, const std::string& cell_file);

  /// Goes on with `speed` times the recorded pace, from the begin when it is at its end.
  void play(double speed, RealTime now);
  void pause(RealTime now);
  /// Goes to `t`, and plays on from there if it was playing. Back is forth from the begin, so that all that adds up is right.
  void seek(double t, RealTime now);

  /// Tells the view what was said up to where the play should be at `now`, at most `most` messages of it. When that is not enough a seek
  /// goes on with the next call, and what plays becomes slower.
  void advance(RealTime now, std::size_t most);

  /// A seek is under way: advance() has more to do at once, and what the view tells meanwhile is of no use to anybody.
  [[nodiscard]] bool seeking() const { return seeking_; }
  /// Since the last call a seek arrived: viewers must forget what they know.
  [[nodiscard]] bool take_arrived() { return std::exchange(arrived_, false); }

  [[nodiscard]] bool playing() const { return playing_; }
  /// Where it is [s].
  [[nodiscard]] double place() const { return place_; }
  [[nodiscard]] double length() const { return length_; }
  /// The frame "player" (docs/monitor.md).
  [[nodiscard]] Frame player() const;
  [[nodiscard]] LiveView& view() { return *view_; }
  [[nodiscard]] const app::LoadedCell& cell() const { return cell_; }

 private:
  Playback(std::string path, app::LoadedCell cell, const recording::Extent& extent);
  void rewind();
  void fetch();
  void pass_until(double t);
  [[nodiscard]] double wanted(RealTime now) const;

  std::string path_;
  app::LoadedCell cell_;
  std::uint64_t begin_;  // of the recording, by its own clock [ns]
  double length_;        // [s]
  std::unique_ptr<recording::RecordingReader> reader_;
  std::unique_ptr<LiveView> view_;
  std::optional<recording::RecordedSample> next_;
  std::string error_;  // nothing more can be read
  double place_ = 0;   // [s]
  double passed_ = 0;  // the view was told of time up to here [s]
  bool playing_ = false, seeking_ = false, arrived_ = false;
  double speed_ = 1;
  double from_ = 0;  // the place at `since_`, or that is sought [s]
  RealTime since_{};
};

}  // namespace interlace::monitor

#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "common/dds/envelope.hpp"
#include "common/mcap/reader.hpp"
#include "common/model/journal.hpp"
#include "common/model/result.hpp"

namespace interlace::recording {

using RecordedMessage = std::variant<dds::CommandMessage, dds::StatusMessage, dds::DispatchMessage, dds::ExecutionMessage,
                                     dds::PostureMessage, model::PlannerState, model::PlannerJournal>;

struct RecordedSample {
  std::string topic;
  std::uint64_t log_time = 0, publish_time = 0;  ///< [ns]
  RecordedMessage message;
};

/// When the first and the last of the messages in a file were received [ns].
struct Extent {
  std::uint64_t from = 0, until = 0;
  std::uint64_t messages = 0;
};

/// Reads the messages of a cell from an MCAP file, in the order they were written. Every message is checked like one that comes from the
/// wire; channels that are not ours are passed over. Not thread-safe.
class RecordingReader {
 public:
  [[nodiscard]] static model::Result<std::unique_ptr<RecordingReader>, std::string> open(const std::string& path);

  /// The next one; empty at the end. An error names the file and what is wrong in it, and ends the reading.
  [[nodiscard]] model::Result<std::optional<RecordedSample>, std::string> next();

  /// Reads over all that is left, and looks at nothing but the times. Errors as of next().
  [[nodiscard]] model::Result<Extent, std::string> skim();

  /// next() passes over the planner's journal, by far the largest part of a recording.
  void leave_out_journal() { journal_ = false; }

  // Known once the first message was read.
  [[nodiscard]] std::optional<std::string> cell_file() const;
  /// Of the metadata; empty when it is not there.
  [[nodiscard]] std::string value(const std::string& key) const;

  /// At the end: the recorder was killed, there may have been more.
  [[nodiscard]] bool cut_off() const { return reader_.cut_off(); }
  /// How much of the file was whole [bytes].
  [[nodiscard]] std::uint64_t whole() const { return reader_.whole(); }

 private:
  RecordingReader(std::string path, std::ifstream file) : path_(std::move(path)), file_(std::move(file)), reader_(file_) {}
  [[nodiscard]] model::Result<std::optional<RecordedMessage>, std::string> decode(const mcap::Message& m) const;

  std::string path_;
  std::ifstream file_;
  mcap::Reader reader_;
  bool journal_ = true;
};

}  // namespace interlace::recording

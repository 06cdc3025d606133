#include "planner/daemon/journal_writer.hpp"

#include "common/app/logging.hpp"

namespace interlace::daemon {

namespace {

constexpr std::chrono::milliseconds kJournalPeriod{100};

}  // namespace

JournalWriter::JournalWriter(dds::Participant& participant, const model::PlannerJournal& head)
    : keeper_(head), writer_(participant, dds::topics::planner_journal(head.cell)) {}

void JournalWriter::send_when_due(Clock::time_point now) {
  while (keeper_.full()) send_one();
  if (now < next_) return;
  next_ = now + kJournalPeriod;
  send_all();
}

void JournalWriter::send_all() {
  while (!keeper_.empty()) send_one();
}

void JournalWriter::send_one() {
  const auto message = keeper_.take();
  if (!message) return;
  const bool sent = writer_.write(*message);
  if (!sent && !failing_) {
    app::log(app::LogLevel::warning, "journal_gap",
             {{"first", message->first}, {"calls", message->calls.size()}, {"why", writer_.last_refusal()}});
  }
  failing_ = !sent;
}

}  // namespace interlace::daemon

#include "planner/daemon/journal_writer.hpp"

#include "common/app/logging.hpp"

namespace interlace::daemon {

namespace {

constexpr std::chrono::milliseconds kJournalPeriod{100};

}  // namespace

JournalWriter::JournalWriter(dds::Participant& participant, const model::PlannerJournal& head)
    : keeper_(head), writer_(participant, dds::topics::planner_journal(head.cell)) {}

void JournalWriter::send_when_due(Clock::time_point now) {
  if (now < next_) return;
  next_ = now + kJournalPeriod;
  send();
}

void JournalWriter::send() {
  const auto batch = keeper_.take();
  if (!batch) return;
  const bool sent = writer_.write(*batch);
  if (!sent && !failing_) {
    app::log(app::LogLevel::warning, "journal_gap",
             {{"first", batch->first}, {"calls", batch->calls.size()}, {"why", writer_.last_refusal()}});
  }
  failing_ = !sent;
}

}  // namespace interlace::daemon

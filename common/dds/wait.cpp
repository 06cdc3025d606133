#include "common/dds/wait.hpp"

#include <algorithm>
#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

Wait::Wait() : set_(std::make_unique<fast::WaitSet>()), woken_(std::make_unique<fast::GuardCondition>()) {
  set_->attach_condition(*woken_);
}

Wait::~Wait() {
  fast::ConditionSeq attached;
  set_->get_conditions(attached);
  for (fast::Condition* condition : attached) set_->detach_condition(*condition);
}

void Wait::attach(ReaderBase& reader) {
  set_->attach_condition(reader.reader_->get_statuscondition());
}

bool Wait::until(Clock::time_point deadline) {
  using std::chrono::nanoseconds;
  const auto left = std::max(nanoseconds{0}, std::chrono::duration_cast<nanoseconds>(deadline - Clock::now()));
  const auto seconds = std::min(std::chrono::duration_cast<std::chrono::seconds>(left), std::chrono::seconds{3600});
  const auto rest = std::min(left - seconds, nanoseconds{999'999'999});
  fast::ConditionSeq active;
  const ReturnCode_t outcome = set_->wait(
      active, eprosima::fastrtps::Duration_t{static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>(rest.count())});
  if (woken_->get_trigger_value()) woken_->set_trigger_value(false);
  return outcome == ReturnCode_t::RETCODE_OK;
}

void Wait::wake() {
  woken_->set_trigger_value(true);
}

}  // namespace interlace::dds

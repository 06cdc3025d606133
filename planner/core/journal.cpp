#include "planner/core/journal.hpp"

#include <cstring>
#include <utility>

namespace interlace::core {
namespace {

/// 64-bit FNV-1a over values, byte by byte.
class Digest {
 public:
  void add(std::uint64_t value) {
    for (int i = 0; i < 8; ++i) {
      hash_ ^= (value >> (8 * i)) & 0xFFU;
      hash_ *= 1099511628211U;
    }
  }
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  void add(Instant t) { add(static_cast<std::uint64_t>(t.time_since_epoch().count())); }
  void add(bool b) { add(std::uint64_t{b}); }
  template <typename Tag>
  void add(const model::StrongName<Tag>& name) {
    add(name.str());
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t{values.size()});
    for (const T& v : values) add(v);
  }
  template <typename Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
  void add(Enum value) {
    add(std::uint64_t{static_cast<std::uint8_t>(value)});
  }
  void add(const model::Vector3& v) {
    for (const double x : v) add(x);
  }
  void add(const model::Joints& q) {
    for (const double x : q) add(x);
  }
  void add(const model::MotionRequest& m) {
    if (const auto* linear = std::get_if<model::LinearTarget>(&m.target)) {
      add(model::Vector3{linear->X_WT.translation()});
      for (Eigen::Index row = 0; row < 3; ++row) add(model::Vector3{linear->X_WT.linear().row(row)});
    } else if (const auto* joint = std::get_if<model::JointTarget>(&m.target)) {
      add(joint->q);
    }
    add(std::uint64_t{m.target.index()});
    add(m.velocity);
    add(m.acceleration);
    add(m.tools.has_value());
    if (!m.tools) return;
    add(m.tools->attach);
    add(m.tools->detach);
    add(m.tools->when);
  }
  void add(const model::Dispatch& d) {
    add(d.id);
    add(d.robot);
    add(std::uint64_t{d.attempt});
    add(d.motion);
    add(d.from);
    add(d.holds);
    add(d.earliest);
    add(d.latest);
    add(d.duration);
  }
  void add(const model::Withdrawal& w) {
    add(w.id);
    add(w.robot);
    add(std::uint64_t{w.attempt});
  }
  void add(const model::Conflict& c) {
    add(c.blocker);
    add(c.own_link);
    add(c.blocker_link);
    add(c.from);
    add(c.until);
    add(c.clearance);
    add(c.place);
  }
  void add(const model::EscapeRefusal& r) {
    add(r.robot);
    add(r.way);
    add(r.text);
  }
  void add(const model::CommandStatus& s) {
    add(s.id);
    add(s.robot);
    add(s.escape);
    add(s.serves);
    add(s.state);
    add(s.reason);
    add(s.text);
    add(s.submitted);
    add(s.start);
    add(s.end);
    add(s.delay);
    add(s.conflicts);
    add(s.refusals);
    add(s.deadline);
    add(s.verdict);
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

constexpr std::size_t kHead = 512;  // of a message, without its calls [bytes]

/// The room a call takes on the wire at most: all names and texts as long as they may be [bytes].
struct Size {
  static constexpr std::size_t kCall = 64, kRotation = 72, kName = 72, kCommand = 640, kEntry = 400;

  std::size_t operator()(const model::ClientRequest& request) const {
    const auto* replaced = std::get_if<model::QueueReplaced>(&request);
    return kCall + kRotation + kCommand + (replaced ? replaced->commands.size() * (kEntry + kRotation) : 0);
  }
  std::size_t operator()(const model::PostureReported& p) const { return kCall + kRotation + 400 + p.holds.size() * kName; }
  std::size_t operator()(const model::ExecutionReported& e) const { return kCall + 600 + e.holds.size() * kName; }
  std::size_t operator()(const model::TimePassed& /*nothing*/) const { return kCall; }
};

}  // namespace

model::PlannerSettings settings_of(const PlannerOptions& o) {
  model::PlannerSettings s;
  s.strategy = o.strategy;
  s.escapes = o.escapes;
  s.lead = o.lead;
  s.start_tolerance = o.start_tolerance;
  s.confirm = o.confirm;
  s.posture_timeout = o.posture_timeout;
  s.answer_timeout = o.answer_timeout;
  s.patience = o.patience;
  s.queue_limit = o.queue_limit;
  s.escape_prefix = o.escape_prefix;
  s.remembered = o.remembered;
  return s;
}

PlannerOptions options_of(const model::PlannerSettings& s) {
  PlannerOptions o;
  o.strategy = s.strategy;
  o.escapes = s.escapes;
  o.lead = s.lead;
  o.start_tolerance = s.start_tolerance;
  o.confirm = s.confirm;
  o.posture_timeout = s.posture_timeout;
  o.answer_timeout = s.answer_timeout;
  o.patience = s.patience;
  o.queue_limit = s.queue_limit;
  o.escape_prefix = s.escape_prefix;
  o.remembered = s.remembered;
  return o;
}

model::DecisionDigest digest_of(const Decisions& d) {
  Digest digest;
  digest.add(d.dispatches);
  digest.add(d.withdrawals);
  digest.add(d.statuses);
  const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  return {count(d.dispatches), count(d.withdrawals), count(d.statuses), digest.value()};
}

Decisions apply(Planner& planner, const model::PlannerEvent& event, Instant now) {
  if (const auto* request = std::get_if<model::ClientRequest>(&event))
    return std::visit([&](const auto& asked) { return planner.on(asked, now); }, *request);
  if (const auto* posture = std::get_if<model::PostureReported>(&event)) return planner.on(*posture, now);
  if (const auto* execution = std::get_if<model::ExecutionReported>(&event)) return planner.on(*execution, now);
  return planner.advance(now);
}

void JournalKeeper::note(Instant now, model::PlannerEvent event, const Decisions& decisions) {
  const std::size_t size = std::visit(Size{}, event);
  if (messages_.empty() || messages_.back().size() >= kMostCalls || size_ + size > kLargest) {
    messages_.emplace_back();
    size_ = kHead;
  }
  size_ += size;
  messages_.back().push_back({now, std::move(event), digest_of(decisions)});
}

std::optional<model::PlannerJournal> JournalKeeper::take() {
  if (messages_.empty()) return std::nullopt;
  model::PlannerJournal taken = head_;
  taken.calls = std::move(messages_.front());
  messages_.pop_front();
  head_.first += taken.calls.size();
  return taken;
}

}  // namespace interlace::core

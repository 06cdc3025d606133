#include <cstdint>
#include <utility>

#include "common/dds/convert.hpp"
#include "common/dds/limits.hpp"
#include "common/dds/validate.hpp"

// The planner's journal ↔ IDL type: the other messages within it, and the orientations to the last bit.
namespace interlace::dds {
namespace {

namespace wire = ::interlace;

constexpr double kOrthonormal = 1e-6;

std::int64_t journal_stamp(model::Instant t) {
  return t.time_since_epoch().count();
}

/// Calls `each` for the target of every linear motion a client asks for, in its order.
template <typename Event, typename Each>
void for_each_linear(Event& event, const Each& each) {
  const auto look_at = [&](auto& command) {
    if (auto* linear = std::get_if<model::LinearTarget>(&command.motion.target)) each(linear->X_WT);
  };
  if (auto* request = std::get_if<model::ClientRequest>(&event)) {
    if (auto* submitted = std::get_if<model::CommandSubmitted>(request)) look_at(*submitted);
    if (auto* replaced = std::get_if<model::QueueReplaced>(request)) {
      for (auto& command : replaced->commands) look_at(command);
    }
  }
  if (auto* posture = std::get_if<model::PostureReported>(&event)) each(posture->X_WT);
}

/// Puts the rotations of the wire into the poses that were read with rounded ones.
void restore_rotations(Validator& v, const std::vector<wire::Rotation>& rotations, model::PlannerEvent& event) {
  std::size_t used = 0;
  for_each_linear(event, [&](model::Pose& X) {
    const std::size_t i = used++;
    if (i >= rotations.size()) return;
    Eigen::Matrix3d R;
    for (std::size_t k = 0; k < 9; ++k) {
      R(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)) = v.number("rotations", rotations[i].rows()[k], 2);
    }
    const bool rotates = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0;
    v.require(rotates, [] { return std::string{"rotations: one is not a rotation"}; });
    X.linear() = R;
  });
  v.require(used == rotations.size(),
            [&] { return "rotations: " + std::to_string(rotations.size()) + " for " + std::to_string(used) + " orientations"; });
}

/// The one message of `found`, which says itself whom it is about; refuses more or less than one.
template <typename Message, typename Wire>
std::optional<Message> read_only(Validator& v, const char* field, const std::vector<Wire>& found) {
  v.require(found.size() == 1, [&] { return std::string{field} + ": " + std::to_string(found.size()) + " in a call of that kind"; });
  if (!v.ok()) return std::nullopt;
  Converted<Message> message = from_wire(found[0], found[0].robot().to_string());
  v.require(message.has_value(), [&] { return std::string{field} + "." + message.error(); });
  if (!message) return std::nullopt;
  return std::move(*message);
}

model::PlannerEvent read_event(Validator& v, const wire::PlannerCall& w) {
  switch (v.known("calls.kind", w.kind(), wire::CALL_ADVANCE)) {
    case wire::CALL_COMMAND:
      if (auto m = read_only<CommandMessage>(v, "calls.command", w.command())) return std::move(m->request);
      break;
    case wire::CALL_POSTURE:
      if (auto m = read_only<PostureMessage>(v, "calls.posture", w.posture())) return std::move(m->posture);
      break;
    case wire::CALL_EXECUTION:
      if (auto m = read_only<ExecutionMessage>(v, "calls.execution", w.execution())) return std::move(m->report);
      break;
    case wire::CALL_ADVANCE: break;
  }
  return model::TimePassed{};
}

model::PlannerSettings read_settings(Validator& v, const wire::PlannerSettings& w) {
  const auto duration = [&](const char* field, std::int64_t ns) { return v.stamp(field, ns).time_since_epoch(); };
  model::PlannerSettings s;
  s.strategy = v.name("settings.strategy", w.strategy().to_string());
  s.escapes = w.escapes();
  s.lead = duration("settings.lead", w.lead());
  s.start_tolerance = duration("settings.start_tolerance", w.start_tolerance());
  s.confirm = duration("settings.confirm", w.confirm());
  if (w.has_posture_timeout()) s.posture_timeout = duration("settings.posture_timeout", w.posture_timeout());
  s.answer_timeout = duration("settings.answer_timeout", w.answer_timeout());
  s.patience = duration("settings.patience", w.patience());
  s.queue_limit = w.queue_limit();
  s.escape_prefix = v.name("settings.escape_prefix", w.escape_prefix().to_string());
  s.remembered = w.remembered();
  return s;
}

wire::PlannerSettings to_settings(const model::PlannerSettings& s) {
  wire::PlannerSettings w;
  w.strategy(s.strategy);
  w.escapes(s.escapes);
  w.lead(s.lead.count());
  w.start_tolerance(s.start_tolerance.count());
  w.confirm(s.confirm.count());
  w.has_posture_timeout(s.posture_timeout.has_value());
  w.posture_timeout(s.posture_timeout.value_or(model::Duration{}).count());
  w.answer_timeout(s.answer_timeout.count());
  w.patience(s.patience.count());
  w.queue_limit(s.queue_limit);
  w.escape_prefix(s.escape_prefix);
  w.remembered(s.remembered);
  return w;
}

/// Fills the event of a call. What the messages say beside it is the transport's, which the core never sees.
struct FillCall {
  wire::PlannerCall& call;

  void operator()(const model::ClientRequest& request) const {
    call.kind(wire::CALL_COMMAND);
    call.command().push_back(to_wire(CommandMessage{request, "journal"}));
  }
  void operator()(const model::PostureReported& posture) const {
    PostureMessage message;
    message.posture = posture;
    message.proxy_incarnation = 1;
    call.kind(wire::CALL_POSTURE);
    call.posture().push_back(to_wire(message));
  }
  void operator()(const model::ExecutionReported& report) const {
    call.kind(wire::CALL_EXECUTION);
    call.execution().push_back(to_wire(ExecutionMessage{0, 0, report}));
  }
  void operator()(const model::TimePassed& /*nothing*/) const { call.kind(wire::CALL_ADVANCE); }
};

}  // namespace

Converted<model::PlannerJournal> from_wire(const wire::PlannerJournal& w, const std::string& owner) {
  Validator v;
  v.require(w.version() == wire::PROTOCOL_VERSION,
            [&] { return "version: " + std::to_string(w.version()) + ", this program speaks " + std::to_string(wire::PROTOCOL_VERSION); });
  model::PlannerJournal journal;
  journal.cell = v.name("cell", w.cell().to_string());
  v.require(journal.cell == owner, [&] { return "cell: '" + journal.cell + "' on the topic of '" + owner + "'"; });
  journal.fingerprint = w.fingerprint();
  journal.incarnation = w.incarnation();
  v.require(w.incarnation() != 0, [] { return std::string{"incarnation: 0 means no planner"}; });
  journal.settings = read_settings(v, w.settings());
  journal.first = w.first();
  v.require(w.calls().size() <= kMaxCalls, [&] { return "calls: " + std::to_string(w.calls().size()) + " are too many"; });
  for (const wire::PlannerCall& c : w.calls()) {
    if (!v.ok()) break;
    model::PlannerCall call;
    call.now = v.stamp("calls.now", c.now());
    call.event = read_event(v, c);
    if (v.ok()) restore_rotations(v, c.rotations(), call.event);
    call.decided = {c.dispatches(), c.withdrawals(), c.statuses(), c.digest()};
    journal.calls.push_back(std::move(call));
  }
  if (!v.ok()) return model::unexpected<std::string>{v.refusal()};
  return journal;
}

wire::PlannerJournal to_wire(const model::PlannerJournal& journal) {
  wire::PlannerJournal w;
  w.version(wire::PROTOCOL_VERSION);
  w.cell(journal.cell);
  w.fingerprint(journal.fingerprint);
  w.incarnation(journal.incarnation);
  w.settings(to_settings(journal.settings));
  w.first(journal.first);
  w.calls().resize(journal.calls.size());
  for (std::size_t i = 0; i < journal.calls.size(); ++i) {
    const model::PlannerCall& call = journal.calls[i];
    wire::PlannerCall& c = w.calls()[i];
    c.now(journal_stamp(call.now));
    std::visit(FillCall{c}, call.event);
    for_each_linear(call.event, [&](const model::Pose& X) {
      wire::Rotation rotation;
      for (std::size_t k = 0; k < 9; ++k) {
        rotation.rows()[k] = X.linear()(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
      }
      c.rotations().push_back(rotation);
    });
    c.dispatches(call.decided.dispatches);
    c.withdrawals(call.decided.withdrawals);
    c.statuses(call.decided.statuses);
    c.digest(call.decided.digest);
  }
  return w;
}

}  // namespace interlace::dds

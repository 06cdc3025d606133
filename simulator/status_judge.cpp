#include "simulator/status_judge.hpp"

#include <fmt/format.h>

#include <set>

namespace interlace::sim {

using model::CommandState;

void StatusJudge::on_status(const model::CommandStatus& status) {
  const auto [entry, fresh] = heard_.try_emplace(status.id);
  Heard& h = entry->second;
  if (!fresh && model::is_final(h.last.state)) h.after_final = true;
  h.escape = h.escape || status.escape;
  h.warned = h.warned || status.reason == model::Reason::deadlock;
  h.last = status;
}

Verdict StatusJudge::verdict(const std::vector<app::CommandRow>& rows) const {
  Verdict v;
  const auto complain = [&v](std::string text) { v.complaints.push_back(std::move(text)); };
  for (const app::CommandRow& row : rows) {
    if (row.escape) continue;
    ++v.submitted;
    const auto found = heard_.find(row.id);
    if (found == heard_.end()) {
      ++v.lost;
      complain(fmt::format("{} lost: never answered", row.id.str()));
      continue;
    }
    const model::CommandStatus& last = found->second.last;
    if (last.state == CommandState::completed) {
      ++v.completed;
      continue;
    }
    ++(last.state == CommandState::rejected ? v.rejected : v.unserved);
    if (last.state == CommandState::queued) continue;  // told with the one before it in the same queue
    complain(fmt::format("{} {}{}{}", row.id.str(), model::to_string(last.state), last.text.empty() ? "" : ": ", last.text));
  }
  if (v.unserved > 0 && v.complaints.empty()) complain(fmt::format("{} commands left in the queues", v.unserved));
  std::set<std::string> fruitless;
  for (const auto& [id, h] : heard_) {
    if (h.after_final) {
      ++v.contradicted;
      complain(fmt::format("{} got a status after its final one", id.str()));
    }
    v.warnings += h.warned ? 1 : 0;
    if (!h.escape) continue;
    ++v.escapes;
    const auto command = heard_.find(h.last.serves);
    if (command == heard_.end() || command->second.last.state != CommandState::completed) fruitless.insert(h.last.serves.str());
  }
  for (const std::string& served : fruitless) complain(fmt::format("escapes for {} completed no command", served));
  v.fruitless_rounds = fruitless.size();
  return v;
}

}  // namespace interlace::sim

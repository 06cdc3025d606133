#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "common/app/report.hpp"
#include "common/model/messages.hpp"

namespace interlace::sim {

/// What a run's statuses came to.
struct Verdict {
  std::size_t submitted = 0, completed = 0, rejected = 0;
  std::size_t unserved = 0;      ///< accepted and, at the end, neither completed nor rejected
  std::size_t lost = 0;          ///< no status ever came
  std::size_t contradicted = 0;  ///< a status came after a final one
  std::size_t escapes = 0;
  std::size_t fruitless_rounds = 0;     ///< escapes that serve one command which never completed, counted once a command
  std::size_t warnings = 0;             ///< commands for which the planner called people
  std::vector<std::string> complaints;  ///< what is wrong, a few words each; empty when everything completed

  [[nodiscard]] bool good() const { return complaints.empty(); }
};

/// Follows the statuses of a run and judges them by what must hold whatever the planner does: every accepted command gets exactly one
/// final status, and every round of escapes serves a command that then completes.
class StatusJudge {
 public:
  void on_status(const model::CommandStatus& status);

  /// `rows`: the commands that were submitted, and escapes, which are left out here.
  [[nodiscard]] Verdict verdict(const std::vector<app::CommandRow>& rows) const;

 private:
  struct Heard {
    model::CommandStatus last;
    bool escape = false, warned = false, after_final = false;
  };
  std::map<model::CommandId, Heard> heard_;
};

}  // namespace interlace::sim

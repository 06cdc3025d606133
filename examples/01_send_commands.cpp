// Sends two commands to each of two robots and waits until all have ended.
// Start a cell first, each program in a terminal of its own:
//   interlace-planner deploy/cells/exp-4-2/cell.yaml
//   interlace-proxy deploy/cells/exp-4-2/cell.yaml --robot r1
//   interlace-proxy deploy/cells/exp-4-2/cell.yaml --robot r2
//   example-01-send-commands
#include <chrono>
#include <iostream>

#include "app_client/client.hpp"

using namespace interlace;
using namespace std::chrono_literals;

namespace {

/// A straight line of the TCP to (x, y, z) [m] in the world frame, the tool as at the start.
model::MotionRequest line_to(double x, double y, double z) {
  model::MotionRequest request;
  request.target = model::LinearTarget{model::make_pose({x, y, z}, model::Quaternion::Identity())};
  return request;
}

}  // namespace

int main() {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  client::ClientOptions options;
  options.cell = "exp-4-2";
  options.name = "example";
  client::Client client{options};
  if (!client.connect(now() + 10s)) {
    std::cerr << "no planner of cell exp-4-2\n";
    return 4;
  }

  // Called for every change; an answer says why a command waits, and for whom.
  client.on_answer([](const client::Answer& answer) {
    std::cout << answer.status.robot.str() << ' ' << answer.status.id.str() << ' ' << model::to_string(answer.status.state) << ' '
              << answer.status.text << '\n';
  });

  const model::RobotName r1{"r1"};
  const model::RobotName r2{"r2"};
  for (const auto& submitted : {client.submit(r1, line_to(0.30, 0.25, 0.33)), client.submit(r1, line_to(0.40, 0.25, 0.33)),
                                client.submit(r2, line_to(0.30, -0.25, 0.33)), client.submit(r2, line_to(0.40, -0.25, 0.33))}) {
    if (!submitted) {
      std::cerr << to_string(submitted.error()) << '\n';
      return 2;
    }
  }
  // Everything happens in here: no threads, no locks.
  const bool done = client.spin_until(now() + 60s, [&] { return client.open() == 0; });
  return done ? 0 : 1;
}

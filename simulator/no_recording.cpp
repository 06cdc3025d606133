#include "simulator/recording.hpp"

namespace interlace::sim {

model::Result<std::unique_ptr<Recording>, std::string> start_recording(const std::string& path, const app::LoadedCell& /*cell*/,
                                                                       const std::string& /*text*/) {
  return model::unexpected{path + ": this interlace-sim was built without DDS and writes no recordings"};
}

}  // namespace interlace::sim

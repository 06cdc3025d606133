#pragma once

#include <string>

#include "common/app/config/cell_file.hpp"
#include "recording/recording_reader.hpp"

namespace interlace::recording {

/// The cell that the recording at `path` is of: from the cell file within it, once `reader` has read a message of it; else from
/// `cell_file`, which stands in for it (empty: there is none). Meshes are looked for beside the recording.
[[nodiscard]] model::Result<app::LoadedCell, std::string> recorded_cell(const RecordingReader& reader, const std::string& path,
                                                                        const std::string& cell_file);

}  // namespace interlace::recording

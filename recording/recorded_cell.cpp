#include "recording/recorded_cell.hpp"

#include "common/app/config/mesh_file.hpp"

namespace interlace::recording {

model::Result<app::LoadedCell, std::string> recorded_cell(const RecordingReader& reader, const std::string& path,
                                                          const std::string& cell_file) {
  const auto text = reader.cell_file();
  if (!text && cell_file.empty()) return model::unexpected{path + ": the cell file is not in it; name it with --cell"};
  auto loaded = text ? app::parse_cell(*text, path + ":cell.yaml", app::read_mesh_file) : app::load_cell(cell_file);
  if (!loaded) return model::unexpected{to_string(loaded.error())};
  return std::move(*loaded);
}

}  // namespace interlace::recording

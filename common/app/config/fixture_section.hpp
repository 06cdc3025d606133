#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/app/config/field.hpp"
#include "common/model/fixture.hpp"
#include "common/model/result.hpp"

namespace interlace::app {

inline constexpr std::size_t kMaxFixtures = 256;        ///< of one cell
inline constexpr std::size_t kMaxTriangles = 200'000U;  ///< of one mesh

/// The mesh in the file at `path`, one unit of which is `scale` [m]; or what is wrong with it.
using MeshReader = std::function<model::Result<std::shared_ptr<const model::TriangleMesh>, std::string>(const std::string& path,
                                                                                                        double scale, bool solid)>;

/// What a cell's `fixtures` list holds. Mesh files are looked for beside the cell file, `file_name`.
[[nodiscard]] std::vector<model::Fixture> read_fixtures(const Field& field, const Units& units, const std::string& file_name,
                                                        const MeshReader& meshes);

}  // namespace interlace::app

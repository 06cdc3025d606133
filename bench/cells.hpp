#pragma once

#include <memory>

#include "common/model/cell.hpp"

namespace interlace::bench {

/// `count` arms on a circle, facing its centre, neighbours' bases 500 mm apart and nobody nearer to the centre than 350 mm: everybody is
/// everybody's neighbour. The dissertation's arm and speeds; homes are tucked back over the bases, as in the patterns of deploy/cells.
[[nodiscard]] std::shared_ptr<const model::Cell> ring(std::size_t count);

/// `count` arms in a row, 500 mm apart, all facing the same way: only those near each other are neighbours. Otherwise as above.
[[nodiscard]] std::shared_ptr<const model::Cell> row(std::size_t count);

}  // namespace interlace::bench

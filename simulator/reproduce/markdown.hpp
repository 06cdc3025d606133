#pragma once

#include <string>
#include <vector>

namespace interlace::reproduce {

/// A table of a Markdown page, columns of numbers aligned right. Each row has as many cells as `header`; cells may not contain line breaks.
[[nodiscard]] std::string markdown_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// "1 escape", "2 escapes", "no escapes".
[[nodiscard]] std::string counted(std::size_t count, const std::string& noun);

}  // namespace interlace::reproduce

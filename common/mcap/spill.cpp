#include "common/mcap/spill.hpp"

#include <algorithm>

namespace interlace::mcap {
namespace {

constexpr std::size_t kPiece = 1U << 16;  // [bytes]

}  // namespace

void Spill::add(const Bytes& bytes) {
  failed_ = failed_ || !file_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) < bytes.size();
  size_ += bytes.size();
}

bool Spill::drain(const std::function<void(const Bytes&)>& take) {
  if (failed_ || std::fseek(file_.get(), 0, SEEK_SET) != 0) return size_ == 0;
  while (size_ > 0) {
    Bytes piece(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, size_)));
    if (std::fread(piece.data(), 1, piece.size(), file_.get()) < piece.size()) return false;
    size_ -= piece.size();
    take(piece);
  }
  return true;
}

}  // namespace interlace::mcap

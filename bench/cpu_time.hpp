#pragma once

#include <time.h>

namespace interlace::bench {

/// What this thread has computed so far [s]: other work on the machine does not count.
inline double cpu_seconds() {
  timespec t{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace interlace::bench

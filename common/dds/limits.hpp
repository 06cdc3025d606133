#pragma once

#include <cstddef>
#include <cstdint>

/// What a value on the wire may be. Wide enough for any cell, narrow enough that arithmetic on it stays sane; see idl/README.md.
namespace interlace::dds {

inline constexpr std::size_t kMaxText = 256;                          ///< [bytes]
inline constexpr std::size_t kMaxConflicts = 16;                      ///< in one message about one robot
inline constexpr std::size_t kMaxRefusals = 16;                       ///< of escapes, likewise
inline constexpr std::size_t kMaxRobots = 128;                        ///< in one cell
inline constexpr std::size_t kMaxReplacement = 100;                   ///< commands that take a queue's place at a time
inline constexpr std::size_t kMaxTools = 32;                          ///< in one cell
inline constexpr std::size_t kMaxCalls = 128;                         ///< of the planner, in one message
inline constexpr double kMaxLength = 1e4;                             ///< |coordinate|, |clearance| [m]
inline constexpr double kMaxAngle = 1e3;                              ///< |joint| [rad]
inline constexpr double kMaxRate = 1e6;                               ///< |velocity| [m/s], |acceleration| [m/s²]
inline constexpr double kMaxSeconds = 1e7;                            ///< duration, delay, uncertainty [s]: four months
inline constexpr std::int64_t kMaxStamp = 3'000'000'000'000'000'000;  ///< |stamp| [ns]: 95 years
inline constexpr double kUnitTolerance = 1e-3;                        ///< a unit quaternion's norm is within this of 1

}  // namespace interlace::dds

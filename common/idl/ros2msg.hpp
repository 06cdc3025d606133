#pragma once

#include <string>
#include <string_view>

namespace interlace::idl {

/// The definition of struct `name` of the wire contract in the language of ROS 2 messages ("ros2msg"), followed by those of all structs it
/// uses, as recordings carry it: tools that know ROS 2 read our plain CDR with it. Enums become uint32 with their values as constants.
/// `idl` is text in the subset of IDL that idl/interlace.idl keeps to. Throws std::invalid_argument, naming what it does not understand.
[[nodiscard]] std::string ros2msg(std::string_view idl, const std::string& name);

/// The text of idl/interlace.idl when this was built.
[[nodiscard]] std::string_view contract();

}  // namespace interlace::idl

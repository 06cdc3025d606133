# Library interlace_idl: the C++ types of idl/interlace.idl, generated into the build tree, never into the sources.
set(INTERLACE_IDL ${PROJECT_SOURCE_DIR}/idl/interlace.idl)
set(_idl_dir ${PROJECT_BINARY_DIR}/generated/fastdds)
file(MAKE_DIRECTORY ${_idl_dir})

find_program(FASTDDSGEN fastddsgen REQUIRED)

add_custom_command(
  OUTPUT ${_idl_dir}/interlace.h ${_idl_dir}/interlace.cxx ${_idl_dir}/interlacePubSubTypes.h ${_idl_dir}/interlacePubSubTypes.cxx
  COMMAND ${FASTDDSGEN} -replace -cs -d ${_idl_dir} ${INTERLACE_IDL}
  DEPENDS ${INTERLACE_IDL}
  COMMENT "Generating the wire types"
  VERBATIM)

add_library(interlace_idl STATIC ${_idl_dir}/interlace.cxx ${_idl_dir}/interlacePubSubTypes.cxx)
target_include_directories(interlace_idl SYSTEM PUBLIC ${_idl_dir})
target_compile_options(interlace_idl PRIVATE -w)
target_link_libraries(interlace_idl PUBLIC fastrtps fastcdr)

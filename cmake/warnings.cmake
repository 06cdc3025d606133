# Warnings of our own code are errors; generated and system headers are not ours.
add_library(interlace_warnings INTERFACE)
target_compile_options(interlace_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wconversion -Wno-sign-conversion -Werror)
# GCC's manual: under a sanitizer this warning finds what is not there, since the instrumented code is no longer understood.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  target_compile_options(interlace_warnings INTERFACE -Wno-maybe-uninitialized)
endif()

# Warnings of our own code are errors; generated and system headers are not ours.
add_library(interlace_warnings INTERFACE)
target_compile_options(interlace_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wconversion -Wno-sign-conversion -Werror)

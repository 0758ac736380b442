# Warnings are errors, for all of our own code.
add_library(octet_warnings INTERFACE)
target_compile_options(octet_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes
  -Wundef -Wvla -Werror)

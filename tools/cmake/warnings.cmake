# For all of our own code. Warnings are errors for developers only (tools/setup): another compiler may warn of more.
option(OCTET_WERROR "treat warnings as errors" OFF)
add_library(octet_warnings INTERFACE)
target_compile_options(octet_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes
  -Wundef -Wvla $<$<BOOL:${OCTET_WERROR}>:-Werror>)
# Constants are enumerators, and some are multiplied by floating-point numbers: only clang warns of that.
target_compile_options(octet_warnings INTERFACE $<$<C_COMPILER_ID:Clang>:-Wno-enum-float-conversion>)
# Code for a chip never casts volatile away; tests do, to inspect registers.
if(NOT OCTET_ON_HOST)
  target_compile_options(octet_warnings INTERFACE -Wcast-qual)
endif()

# Address and undefined-behaviour sanitizers, at compile and at link: at link alone they find nothing.
option(OCTET_SANITIZE "build with ASan and UBSan" OFF)
if(OCTET_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(CMAKE_C_COMPILER_ID STREQUAL GNU)
    add_compile_options(-fsanitize=bounds-strict)
  endif()
  add_link_options(-fsanitize=address,undefined)
endif()

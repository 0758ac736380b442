# Address and undefined-behaviour sanitizers, at compile and at link: at link alone they find nothing.
option(OCTET_SANITIZE "build with ASan and UBSan" OFF)
if(OCTET_SANITIZE)
  add_compile_options(-fsanitize=address,undefined$<$<C_COMPILER_ID:GNU>:,bounds-strict> -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

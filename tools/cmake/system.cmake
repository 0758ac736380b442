# The differences between target systems. No other file here checks which system it is.
set(OCTET_ON_HOST TRUE)     # programs and libraries for an operating system; else an image or a page
set(OCTET_HAS_LINKS FALSE)  # supports the sockets and serial lines of hal/link, and the robot as a process
set(OCTET_ELF_OPTIONS)      # bind a library's internal calls to itself, so that they can be inlined
set(OCTET_MAPS FALSE)       # the linker supports version scripts
if(CMAKE_SYSTEM_NAME STREQUAL Generic)
  set(OCTET_ON_HOST FALSE)
elseif(CMAKE_SYSTEM_NAME STREQUAL Linux)
  set(OCTET_HAS_LINKS TRUE)
  set(OCTET_ELF_OPTIONS -Wl,-Bsymbolic)
  add_compile_options(-fno-semantic-interposition)
  if(CMAKE_C_COMPILER_ID STREQUAL GNU)
    add_link_options(-flto-partition=one)  # without make, gcc 14 warns about several partitions
  endif()
  set(OCTET_MAPS TRUE)
else()
  # Python loads a library by its path, so it has the same name on every system.
  set(CMAKE_SHARED_LIBRARY_PREFIX lib)
  set(CMAKE_SHARED_LIBRARY_SUFFIX .so)
endif()

# octet_exports(LIBRARY MAP): exports the symbols in the map; without version scripts, all symbols.
function(octet_exports library map)
  if(OCTET_MAPS)
    target_link_options(${library} PRIVATE LINKER:--version-script=${map})
    set_target_properties(${library} PROPERTIES LINK_DEPENDS ${map})
  endif()
endfunction()

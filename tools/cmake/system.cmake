# What differs between the systems that this is built for. No other file here asks which one it is.
set(OCTET_ON_HOST TRUE)     # a program or a library of an operating system; else an image, or a page
set(OCTET_HAS_LINKS FALSE)  # this system has the sockets and the lines of hal/link, and the robot as a process
set(OCTET_ELF_OPTIONS)      # a library's calls within itself stay within it, and may be inlined
set(OCTET_MAPS FALSE)       # the linker takes a map of what a library exports
if(CMAKE_SYSTEM_NAME STREQUAL Generic)
  set(OCTET_ON_HOST FALSE)
elseif(CMAKE_SYSTEM_NAME STREQUAL Linux)
  set(OCTET_HAS_LINKS TRUE)
  set(OCTET_ELF_OPTIONS -Wl,-Bsymbolic)
  add_compile_options(-fno-semantic-interposition)
  if(CMAKE_C_COMPILER_ID STREQUAL GNU)
    add_link_options(-flto-partition=one)  # gcc 14 warns of several where make is missing
  endif()
  set(OCTET_MAPS TRUE)
else()
  # Python loads a library by its path: it has one name everywhere.
  set(CMAKE_SHARED_LIBRARY_PREFIX lib)
  set(CMAKE_SHARED_LIBRARY_SUFFIX .so)
endif()

# octet_exports(LIBRARY MAP): exports what the map names; where the linker takes none, all that it is made of.
function(octet_exports library map)
  if(OCTET_MAPS)
    target_link_options(${library} PRIVATE LINKER:--version-script=${map})
    set_target_properties(${library} PROPERTIES LINK_DEPENDS ${map})
  endif()
endfunction()

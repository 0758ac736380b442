# octet_native_library(TARGET STATIC_LIBRARIES PREFIX HEADER...): a shared library for Python, made of static ones.
# Its function PREFIXstamp returns the SHA-256 sums of the headers, concatenated. Python compares them with the
# headers that it reads, and so detects a library that was built from others.
function(octet_native_library target static prefix)
  if(NOT OCTET_ON_HOST)
    return()   # Python runs on the host
  endif()
  set(texts "")
  foreach(header ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
    file(SHA256 ${header} digest)
    string(APPEND texts ${digest})
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${prefix}stamp.c)
  file(CONFIGURE OUTPUT ${source} CONTENT
    "const char *${prefix}stamp(void);\n\nconst char *${prefix}stamp(void)\n{\n    return \"${texts}\";\n}\n")
  list(TRANSFORM static REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(${target} SHARED ${source} ${objects})
  target_link_libraries(${target} PRIVATE octet_warnings ${static} ${OCTET_ELF_OPTIONS})
  string(REGEX REPLACE "_shared$" "" name ${target})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
endfunction()

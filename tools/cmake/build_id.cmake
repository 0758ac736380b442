# Generates build_id.h, the commit of the sources, in OCTET_GENERATED: checked at each build, rewritten if changed.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  # The second output is never made, so the command runs at each build.
  add_custom_command(
    OUTPUT ${OCTET_GENERATED}/build_id.h ${OCTET_GENERATED}/build_id.always
    COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D HEADER=${OCTET_GENERATED}/build_id.h
            -P ${CMAKE_CURRENT_LIST_FILE}
    COMMENT "Looking up what this is built from"
    VERBATIM)
  add_custom_target(octet_build_id DEPENDS ${OCTET_GENERATED}/build_id.h)
  return()
endif()

# git VARIABLE COMMAND...: git's one line of output, or nothing. A repository that encloses SOURCE does not count.
get_filename_component(above ${SOURCE} DIRECTORY)
set(ENV{GIT_CEILING_DIRECTORIES} ${above})
macro(git variable)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE ${variable} ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endmacro()

git(describe describe --always --dirty=+ --abbrev=6)
git(commit rev-parse --verify --quiet HEAD)
if(commit)
  string(SUBSTRING ${commit} 0 6 commit)
else()
  set(describe unknown)
  set(commit 0)
endif()
string(REGEX MATCH "[+]$" modified "${describe}")
if(modified)
  set(modified 1)
else()
  set(modified 0)
endif()

file(CONFIGURE OUTPUT ${HEADER} CONTENT [[
#define OCTET_BUILD_DESCRIBE "@describe@"
#define OCTET_BUILD_COMMIT 0x@commit@u
#define OCTET_BUILD_MODIFIED @modified@
]] @ONLY)

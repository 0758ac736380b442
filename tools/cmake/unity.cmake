# Unity, the unit-test framework: tools/setup fetches it into UNITY_DIR, pinned by hash.
set(UNITY_DIR ${PROJECT_SOURCE_DIR}/build/unity CACHE PATH "where unity.c and its headers are")
if(NOT EXISTS ${UNITY_DIR}/unity.c)
  message(FATAL_ERROR "Unity is not in ${UNITY_DIR}: run tools/setup tests")
endif()

get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
add_library(unity STATIC ${UNITY_DIR}/unity.c ${root}/tests/test.c)
set_source_files_properties(${root}/tests/test.c PROPERTIES
  COMPILE_OPTIONS $<TARGET_PROPERTY:octet_warnings,INTERFACE_COMPILE_OPTIONS>)
target_include_directories(unity SYSTEM PUBLIC ${UNITY_DIR})
target_include_directories(unity PUBLIC ${root})
target_compile_definitions(unity PUBLIC UNITY_INCLUDE_DOUBLE)   # for the world; the robot uses integers only

# octet_add_test(NAME COMMAND...): adds a Unity program to ctest. If no test runs, or if tests are ignored, Unity
# exits with 0: that is a failure here.
function(octet_add_test name)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES FAIL_REGULAR_EXPRESSION "\n0 Tests;[1-9][0-9]* Ignored" TIMEOUT 60)
endfunction()

# octet_test_part(PATH LIBRARY...): PATH.c, which several tests link: it is compiled once.
function(octet_test_part path)
  get_filename_component(name ${path} NAME)
  add_library(${name} OBJECT ${path}.c)
  target_link_libraries(${name} PRIVATE unity octet_warnings ${ARGN})
endfunction()

# octet_test([FOLDER/]NAME LIBRARY...): a test program, FOLDER/test_NAME, from test_NAME.c in that folder.
function(octet_test path)
  get_filename_component(name ${path} NAME)
  get_filename_component(folder ${path} DIRECTORY)
  if(folder)
    string(APPEND folder /)
  endif()
  add_executable(test_${name} ${folder}test_${name}.c)
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${folder})
  target_link_libraries(test_${name} PRIVATE unity octet_warnings ${ARGN})
  octet_add_test(${name} test_${name})
endfunction()

# A user's behaviour in C takes the place of firmware/behaviours/own.c in an image (host_sim/sim/own_brain.py).
set(OCTET_OWN_BRAIN "" CACHE FILEPATH "a user's behaviour in C, which takes the place of behaviours/own.c")
if(OCTET_OWN_BRAIN)
  get_target_property(sources octet_core SOURCES)
  list(FILTER sources EXCLUDE REGEX "/own\\.c$")
  set_target_properties(octet_core PROPERTIES
    SOURCES "${sources};${OCTET_OWN_BRAIN};${PROJECT_SOURCE_DIR}/host_sim/program/own/image.c")
  set_source_files_properties(${OCTET_OWN_BRAIN} TARGET_DIRECTORY octet_core PROPERTIES
    COMPILE_OPTIONS "-w;-Wno-error;-I${PROJECT_SOURCE_DIR}/host_sim/program/own;-include;octet_brain.h")
endif()

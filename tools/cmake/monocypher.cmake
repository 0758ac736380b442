# Monocypher, for signatures: tools/setup fetches it into MONOCYPHER_DIR, pinned by hash.
set(MONOCYPHER_DIR ${PROJECT_SOURCE_DIR}/build/monocypher CACHE PATH "where monocypher.c and its header are")
if(NOT EXISTS ${MONOCYPHER_DIR}/monocypher.c)
  message(FATAL_ERROR "Monocypher is not in ${MONOCYPHER_DIR}: run tools/setup images")
endif()
add_library(monocypher STATIC ${MONOCYPHER_DIR}/monocypher.c)
target_include_directories(monocypher SYSTEM PUBLIC ${MONOCYPHER_DIR})

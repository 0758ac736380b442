# Monocypher, for signatures: tools/setup fetches it into MONOCYPHER_DIR, pinned by hash.
set(MONOCYPHER_DIR ${PROJECT_SOURCE_DIR}/build/monocypher CACHE PATH "where monocypher.c and its header are")
if(NOT EXISTS ${MONOCYPHER_DIR}/monocypher.c)
  message(FATAL_ERROR "Monocypher is not in ${MONOCYPHER_DIR}: run tools/setup images")
endif()

# 2.1 kB smaller and a third slower: squares by fe_mul; one multiple of the base point instead of eight, as its
# comments suggest; and 2 Z^2, the only use of fe_mul_small here, as 2 Z times Z.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${MONOCYPHER_DIR}/monocypher.c)
file(READ ${MONOCYPHER_DIR}/monocypher.c fast)
string(REGEX REPLACE "fe_sq *\\(([^,()]+),([^,()]+)\\);" "fe_mul(\\1,\\2,\\2);" small "${fast}")
string(REPLACE "fe_mul(q->Z, p->Z, p->Z);          // qZ = pZ^2\n\tfe_mul_small(q->Z, q->Z, 2);"
  "fe_add(q->Z, p->Z, p->Z);\n\tfe_mul(q->Z, q->Z, p->Z);" small "${small}")
string(REPLACE "#define B_W_WIDTH 5" "#define B_W_WIDTH 2" small "${small}")
string(REPLACE "ge_precomp b_window[8] =" "ge_precomp b_window[1] =" small "${small}")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/monocypher.c CONTENT "${small}" @ONLY)
add_library(monocypher STATIC ${PROJECT_BINARY_DIR}/generated/monocypher.c)
target_include_directories(monocypher SYSTEM PUBLIC ${MONOCYPHER_DIR})
target_compile_options(monocypher PRIVATE -w -fno-tree-ter)   # seven multiples go unused; saves 100 bytes

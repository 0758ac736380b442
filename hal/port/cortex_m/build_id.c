/* The identity of this image, searched for in the image by tools/flash. */
#include "build_id.h"

__attribute__((section(".build_id"), used))
static const char build_id[] =
    "octet-image board=" OCTET_BOARD " chip=" OCTET_CHIP " node=" OCTET_NODE_TEXT
    " bitrate=" OCTET_BITRATE_TEXT " version=" OCTET_BUILD_DESCRIBE " dbc=" OCTET_DBC_HASH;

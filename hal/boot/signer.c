/* The public key whose images are accepted, set by the build. */
#include "hal/boot/image.h"

const uint8_t IMAGE_SIGNER[IMAGE_KEY] = {OCTET_SIGNER_BYTES};

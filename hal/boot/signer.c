/* Whose images are taken, as the build was told. */
#include "hal/boot/image.h"

const uint8_t IMAGE_SIGNER[IMAGE_KEY] = {OCTET_SIGNER_BYTES};

// Index of the first input attachment that lights have been added to, or marked in, ahead of shading.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

#ifdef HEARTH_SAMPLED
const uint kFirstLightInput = kInputLightSampled;
#else
const uint kFirstLightInput = kInputLight;
#endif

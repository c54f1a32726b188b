// Shadow maps of the frame. Needs formats/gpu_shared/shadow.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

layout(set = kSetScene, binding = kSceneShadows, std140) uniform Shadows { ShadowBlock shadows; };

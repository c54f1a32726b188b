// Visibility buffer at the pixel: an input attachment of the subpass or, with HEARTH_SAMPLED, an image that
// an earlier render pass has stored.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

#ifndef HEARTH_VISIBILITY_SET
#define HEARTH_VISIBILITY_SET kSetAttachments
#endif

#ifdef HEARTH_SAMPLED
layout(set = HEARTH_VISIBILITY_SET, binding = kAttachmentVisibility) uniform usampler2D visibility;

uint loadVisibility() { return texelFetch(visibility, ivec2(gl_FragCoord.xy), 0).x; }
#else
layout(input_attachment_index = kInputVisibility, set = HEARTH_VISIBILITY_SET, binding = kAttachmentVisibility)
    uniform usubpassInput visibility;

uint loadVisibility() { return subpassLoad(visibility).x; }
#endif

// Visibility buffer as an input attachment of the subpass.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

layout(input_attachment_index = kInputVisibility, set = kSetAttachments, binding = kAttachmentVisibility)
    uniform usubpassInput visibility;

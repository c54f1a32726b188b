// Reads the composite image of a Photoshop file (PSD, PSB), which shows all its layers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/images/samples.h"

#include <span>

namespace hearth::images
{

/// Read the composite: bitmap, grey, duotone (as grey), indexed, RGB or CMYK, of 1, 8, 16 or 32 bits a
/// channel.
/// errors: image_malformed, image_unsupported (no composite, other colours), input_too_large
Result<Samples> readPsd(const Request& request, std::span<const std::byte> bytes);

} // namespace hearth::images

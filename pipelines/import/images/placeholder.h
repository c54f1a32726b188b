// What is drawn in place of an image that is missing or broken.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Magenta and black squares: easily seen, and in no one's art.
DecodedImage placeholderImage();

} // namespace hearth::import

// Makes the image that is drawn in place of a missing or broken one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Return magenta and black squares: conspicuous, and unlike any artwork.
DecodedImage makePlaceholderImage();

} // namespace hearth::import

// Counts the errors of an encoded image once more, plainly, to judge those that its record stores.
// Source: formats/FORMAT.md, ImageRecord; docs/textures.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"

#include <cstddef>
#include <span>

namespace hearth::bench
{

/// Errors as shares of the range, of normals in radians, of light in stops.
struct Recount
{
    double error = 0;    ///< root mean square over the measured mips
    double smooth = 0;   ///< the same of smooth cells; 0 where less than half of the cells are smooth
    double p999 = 0;     ///< 99.9 % of the texels of mip 0 have no larger error
    double coverage = 0; ///< largest change of the share of texels that pass the alpha test
};

/// Count the errors of an image.
/// plain   before it was encoded, with its role and the channels that shaders read
/// stored  record of the encoded image
/// mips    of the encoded image, as PackView::imageData returns them
Recount recountErrors(const texels::PlainImage& plain, const formats::ImageRecord& stored,
                      std::span<const std::byte> mips);

} // namespace hearth::bench

// Finds what materials read of an image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"
#include "formats/pack/image_uses.h"

#include <span>

namespace hearth::texels
{

struct ImageReads
{
    formats::ImageRole role = formats::ImageRole::data;
    Channels channels = 0;
};

/// Return the role of an image, and the channels that shaders read. An image with several uses gets the role
/// that is measured most strictly; one without a use keeps all channels.
///
/// image      plain: its format and flags tell colour, data, normals and light apart
/// uses       of this image
/// materials  of the import part; their alpha modes tell whether alpha is opacity
ImageReads findReads(const formats::ImageRecord& image, std::span<const formats::ImageUse> uses,
                     std::span<const formats::MaterialRecord> materials);

} // namespace hearth::texels

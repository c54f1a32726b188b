// Merges the images of all sources: equal ones are stored once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::link
{

/// Place of an image in the parts.
struct ImagePlace
{
    uint32_t source;
    uint32_t image;      ///< in the part
    float target;        ///< of its record, or a stricter one of an equal image
    float target_smooth; ///< the same
};

/// Images of a pack.
class ImageTable
{
public:
    /// Compare images by their records, without names and targets, and by their bytes as they are stored.
    /// parts  the textures or texels part of each source
    explicit ImageTable(std::span<const formats::PackView* const> parts);

    /// Return the places of the images of the pack, in its order: the first of equal ones.
    std::span<const ImagePlace> places() const { return places_; }

    /// Return the image of the pack for an index into all images of all sources, one source after the other.
    /// kInvalidIndex, and an index that does not exist, stay as they are.
    uint32_t find(uint32_t image) const { return image < images_.size() ? images_[image] : image; }

private:
    std::vector<ImagePlace> places_;
    std::vector<uint32_t> images_; ///< [image of all sources]: that of the pack
};

} // namespace hearth::link

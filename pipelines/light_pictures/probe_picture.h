// Draws the mips of light probes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/light_pictures/light_picture.h"

namespace hearth::light_pictures
{

/// Mips of a probe, decoded. The record must outlive it.
struct ProbeMips
{
    const formats::ProbeRecord& record;
    std::vector<std::vector<Float3>> mips; ///< face, row, column; radiance over the mean irradiance

    uint32_t side(size_t mip) const { return formats::finestProbeSide(record) >> mip; }
    double roughness(size_t mip) const;
};

ProbeMips decodeMips(const formats::PackView& file, const formats::ProbeRecord& record);

/// Lay out the six faces of a mip side by side, the mips below each other.
/// first_mip  finest mip to draw
LightPicture drawProbe(const ProbeMips& probe, size_t first_mip = 0);

} // namespace hearth::light_pictures

// Packs the light of an atlas of receivers: chooses the lamps of each texel, and gathers texels with the same
// lamps in blocks, as parts and packs store them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/select/select.h"
#include "formats/records/receivers.h"

#include <span>
#include <vector>

namespace hearth::receivers
{

/// Irradiance that was baked for each lamp apart.
struct BakedLight
{
    uint32_t width = 0, height = 0;                     ///< of the atlas, 1 to shared::kMaxReceiverSide
    std::span<const formats::ReceiverLampRecord> lamps; ///< rising; steady light is the first or absent
    std::span<const formats::ReceiverRectRecord> rects; ///< by rising instance; they do not overlap
    std::span<const uint8_t>
        valid; ///< [width * height], row by row: 1 where a texel receives; 0 outside rects
    std::span<const Float3> light; ///< [width * height][lamps]: with weight 1, finite and at least 0
};

struct AtlasOptions
{
    SelectOptions select;
    formats::ReceiverCodec codec = formats::ReceiverCodec::rgb9e5;
};

/// Atlas as it is stored, and figures for a report.
struct Atlas
{
    formats::ReceiverAtlasRecord record{};
    std::vector<formats::ReceiverLampRecord> lamps;
    std::vector<formats::ReceiverRectRecord> rects;
    std::vector<formats::ReceiverBlockRecord> blocks;
    std::vector<uint32_t> words;
    uint64_t color_count = 0;    ///< of all texels
    uint64_t triple_count = 0;   ///< records of three colours that all texels need
    uint64_t dropping_count = 0; ///< texels with shared::kReceiverDrops
    double largest_dropped = 0;  ///< largest channel of a lamp that a texel dropped, over that of its sum

    formats::ReceiverTables tables() const { return {record, lamps, rects, blocks, words}; }
};

/// Pack an atlas. Texels without light have no record. Always the same bytes.
Atlas packAtlas(const BakedLight& baked, const AtlasOptions& options);

/// Pack the faces of a grid of bricks, as texels in rows of shared::kMaxReceiverSide.
/// light  [face_count][lamps]: radiance that leaves the face with weight 1, as BakedLight::light
Atlas packFaces(std::span<const formats::ReceiverLampRecord> lamps, std::span<const Float3> light,
                uint32_t face_count, const AtlasOptions& options);

} // namespace hearth::receivers

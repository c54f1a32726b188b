// Encodes the visibility of a vertex; formats/gpu_shared/visibility_cone.h defines the code and decodes it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/visibility_cone.h"

namespace hearth::formats
{

/// Code of the unoccluded hemisphere: decodes to exactly m0 = 2 pi and m1 = pi n.
inline constexpr uint32_t kVisibilityUnoccluded = 0x1FF;

constexpr bool isLegalVisibility(uint32_t code)
{
    return (code >> 16 & 0xFFu) != 0x80 && code >> 24 != 0x80;
}

/// Return the code nearest to the moments, in the space of `normal`. Infeasible moments are made feasible
/// first. m1 below the surface, or more than pi / 2 along it, is clamped. Without clamping, dot(n, m1) / pi
/// has an error of at most 1/1022, m1 / pi along either vector of the frame 1/508, and |m1| / m0 1/254 from
/// the nearest feasible value with the new |m1|.
///
/// m0, m1  finite
/// normal  as decodeNormal decodes its own code
inline uint32_t encodeVisibility(float m0, Float3 m1, Float3 normal)
{
    const shared::VisibilityMoments moments = shared::feasibleVisibility(m0, m1);
    const NormalFrame frame = makeNormalFrame(normal);
    const Float3 p =
        Float3{dot(moments.m1, frame.first), dot(moments.m1, frame.second), dot(moments.m1, normal)} /
        shared::kVisibilityPi;
    const uint32_t along = quantizeUnorm(p.z, 511);
    const auto across = [](float value)
    { return static_cast<int32_t>(std::lround(std::clamp(value, -0.5f, 0.5f) * 254)); };
    const int32_t first = across(p.x), second = across(p.y);
    const float x =
        shared::visibilityLength({static_cast<float>(first) / 254.0f, static_cast<float>(second) / 254.0f,
                                  static_cast<float>(along) / 511.0f});
    const float least = shared::visibilityRatio(x, 0), greatest = shared::visibilityRatio(x, 1);
    uint32_t ratio = 0;
    if (moments.m0 > 0 && greatest > least)
        ratio = quantizeUnorm((length(moments.m1) / moments.m0 - least) / (greatest - least), 127);
    return along >> 1 | (along & 1) << 8 | ratio << 9 | (static_cast<uint32_t>(first) & 0xFFu) << 16 |
           (static_cast<uint32_t>(second) & 0xFFu) << 24;
}

} // namespace hearth::formats

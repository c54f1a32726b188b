// Tells whether the UVs of an instance can address baked texels, and how many texels they need.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/texel_domain.h"

#include <string>

namespace hearth::receivers
{

inline constexpr uint32_t kMinRectangleSide = 4, kMaxRectangleSide = 4096; ///< texels

/// Largest share of overlap of a usable UV set (TexelDomain::overlap).
inline constexpr double kMaxOverlap = 0.01;

/// Largest share of an instance's area that may have no area in UV.
inline constexpr double kMaxFlat = 0.01;

struct RectangleSize
{
    uint32_t width = 0, height = 0; ///< texels
    friend bool operator==(const RectangleSize&, const RectangleSize&) = default;
};

/// Choose the size of an instance's rectangle such that its texels have the density on average, along each
/// axis of UV, weighted by area.
/// texels_per_metre  above 0
/// returns           kMinRectangleSide to kMaxRectangleSide each way
RectangleSize chooseRectangle(std::span<const Triangle> triangles, double texels_per_metre);

enum class UvUse
{
    usable,
    flat,        ///< triangles without an area in UV, as of a mesh without UVs
    outside,     ///< triangles outside [0, 1]
    overlapping, ///< several triangles at one place
};

/// Judgement of a UV set.
struct UvCheck
{
    UvUse use = UvUse::usable;
    double share = 0; ///< of the area of triangles, or of the points (overlapping), that the refusal is for
};

/// Check UVs before they are rasterised, for all but overlaps. Of triangles without area nothing is asked.
UvCheck checkUvs(std::span<const Triangle> triangles);

/// Check the overlap of a rasterised domain.
UvCheck checkOverlap(const TexelDomain& domain);

/// Check all of UVs whose density is not known yet.
UvCheck checkUvsAndOverlap(std::span<const Triangle> triangles);

/// Return a clause for a message, such as "12.5 % of its UVs overlap". Empty if usable.
std::string describe(const UvCheck& check);

} // namespace hearth::receivers

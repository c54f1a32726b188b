// Says which materials take part in the light of a scene: one rule for occlusion, global illumination and
// shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

namespace hearth::formats
{

/// Return whether surfaces of a material take part in the light of a scene. Unlit ones (KHR_materials_unlit)
/// do not: they are mostly painted skies, which would hide all light behind them. They occlude no sky, cast
/// no shadows and are not in bricks.
inline bool isLit(const MaterialRecord& material)
{
    return (material.flags & kMaterialUnlit) == 0;
}

} // namespace hearth::formats

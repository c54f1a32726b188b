// Finds how much of a lamp's light the surfaces right around it, such as its shade, give back, and where to.
//
// Voxels do not resolve a shade: faces nearer to a lamp than a voxel get none of its light
// (shared::brickUnshadowedLight). Yet the inside of a shade sends more light to the table below than the lamp
// itself. Seen from afar that light comes from the lamp's place, so it becomes an intensity beside the lamp's
// (formats/gpu_shared/reflector.h), which has the lamp's shadows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/base/result.h"
#include "formats/records/bricks.h"

#include <vector>

namespace hearth::bricks
{

/// Return the reflectors of the lights of all sources, in order, as many as the runtime draws; all 0 for suns
/// and for lights that a clip moves. Empty if no light has one. Follows paths from each lamp among the
/// clusters of a LOD cut until they leave the lamp's surroundings (shared::brickLampReach). The result does
/// not depend on the number of threads.
/// error  metres: LOD error of the cut
/// errors: errors of decoding pages
Result<std::vector<formats::ReflectorRecord>> findReflectors(const StaticScene& scene, const GridFrame& frame,
                                                             double error);

} // namespace hearth::bricks

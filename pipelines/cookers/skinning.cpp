// hearth-skinning: bounds of skinned clusters that hold through every animation.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Cooker describeSkinning()
{
    return {.name = "skinning", .reads = {"import", "clusters"}, .cost = {8 * kMiB, 0.9, 0.002}};
}

} // namespace hearth::cookers

// hearth-specular: the table of specular occlusion, which shading with visibility cones needs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Cooker describeSpecular()
{
    return {.name = "specular",
            .scope = settings::Scope::pack,
            .switched_by = "visibility.mode",
            .link_option = "--specular",
            .cost = {16 * kMiB, 0, 0}};
}

} // namespace hearth::cookers

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/texel_arguments.h"

#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Result<Arguments> makeTexelArguments(const settings::Values& values)
{
    Arguments arguments;
    addOption(values, "textures.families", "--family", arguments);
    addOption(values, "textures.quality", "--quality", arguments);
    addFlag(values, "textures.strict", "--strict", arguments);
    for (const char* key : {"textures.role", "textures.image"})
        addAssignment(values, key, arguments);
    return arguments;
}

} // namespace hearth::cookers

// hearth-estimates: errors of all formats of the textures of a source, for a budget.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/texel_arguments.h"
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Cooker describeEstimates()
{
    return {.name = "estimates",
            .switched_by = "textures.families",
            .reads = {"import", "textures"},
            .needed_by = "budget",
            .is_linked = false,
            .extension = ".json",
            .makeArguments = makeTexelArguments,
            .cost = {32 * kMiB, 4.5, 1}};
}

} // namespace hearth::cookers

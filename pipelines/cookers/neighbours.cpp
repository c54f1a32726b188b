// hearth-neighbours: for each source the sources that can occlude it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Cooker describeNeighbours()
{
    return {.name = "neighbours",
            .scope = settings::Scope::pack,
            .switched_by = "visibility.mode",
            .reads = {"import"},
            .reads_statistics = true,
            .lists = Lists::neighbours,
            .is_linked = false,
            .extension = ".txt",
            .cost = {16 * kMiB, 0, 0}};
}

} // namespace hearth::cookers

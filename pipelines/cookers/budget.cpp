// hearth-budget: formats of all textures of a pack whose bytes are limited.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/texel_arguments.h"
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

Result<Arguments> makeBudgetArguments(const Values& values)
{
    Arguments arguments;
    addOption(values, kTextureBudget, "--bytes", arguments);
    return arguments;
}

} // namespace

Cooker describeBudget()
{
    return {
        .name = "budget",
        .scope = Scope::pack,
        .switched_by = kTextureBudget,
        .reads = {"estimates"},
        .lists = Lists::words,
        .is_linked = false,
        .extension = ".txt",
        .has_statistics = true,
        .settings = {{std::string(kTextureBudget), Kind::size,
                      "bytes that the textures of the pack may take on the GPU, as 48M: compressed formats "
                      "with the least error together, instead of an error for each",
                      "off"}},
        .makeArguments = makeBudgetArguments,
        .cost = {16 * kMiB, 0, 0}};
}

} // namespace hearth::cookers

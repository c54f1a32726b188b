// hearth-link: from parts to a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/texel_arguments.h"
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

namespace
{

Result<Arguments> makeLinkArguments(const settings::Values& values)
{
    Arguments arguments;
    addOption(values, kTextureBudget, "--texture-budget", arguments);
    return arguments;
}

} // namespace

Cooker describeLink()
{
    return {.name = "link",
            .scope = settings::Scope::pack,
            .makeArguments = makeLinkArguments,
            .cost = {16 * kMiB, 3, 0.01}};
}

} // namespace hearth::cookers
